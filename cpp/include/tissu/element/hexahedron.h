#pragma once

/// Hexahedron8, the trilinear hexahedron. Made from the table of elements, like all others.

#include "tissu/element/generated/hexahedron.h"
