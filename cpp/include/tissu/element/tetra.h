#pragma once

/// Tetra4, the linear tetrahedron. Made from the table of elements, like all others.

#include "tissu/element/generated/tetra.h"
