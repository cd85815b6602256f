#pragma once

/// Hooke is made from its energy like every law.

#include "tissu/law/generated/hooke.h"  // IWYU pragma: export
