#pragma once

/// StVK is made from its energy like every law.

#include "tissu/law/generated/stvk.h"  // IWYU pragma: export
