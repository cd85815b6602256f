#pragma once

/// Parts of reference cells, and rules on them.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/element/reference_cell.h"

namespace tissu {

/// Coordinates in a reference cell; those beyond its dimension are zero.
using ReferencePoint = std::array<double, 3>;

/// The places of an element's nodes in its reference cell; empty if no element has that name.
std::vector<ReferencePoint> reference_nodes(std::string_view element);

/// The length of a part of a line between two points of its reference cell, the area of a triangle in that of
/// a face.
double reference_measure(std::span<const ReferencePoint> part);

/// The element with a rule on such a part, instead of on its whole reference cell: exact for polynomials of
/// this degree, 8 at most, and on a line always of degree 5.
ReferenceCell reference_part(std::string_view element, std::span<const ReferencePoint> part, int degree = 8);

}  // namespace tissu
