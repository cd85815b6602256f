#pragma once

/// Size and shape of cells, and the one repair there is: turning round cells numbered in reverse.

#include <cstdint>
#include <vector>

#include "tissu/mesh/mesh.h"

namespace tissu {

/// Smallest and largest determinant of dx/dxi in a cell [m3]; negative where the cell is inside out.
struct JacobianRange {
  double smallest;
  double largest;
};

/// Volume of each cell [m3], negative when it is inside out. Tetrahedra: det / 6; hexahedra: 2x2x2 Gauss
/// points, exact for straight edges.
std::vector<double> volumes(const Mesh& mesh);

/// Tetrahedra: the constant determinant (6 V); hexahedra on [-1, 1]^3: over the 2x2x2 Gauss points, where
/// forces are evaluated.
std::vector<JacobianRange> jacobian_ranges(const Mesh& mesh);

/// Shape of each cell: 1 is ideal, 0 flat, negative inside out.
/// Tetrahedra: 6 sqrt(2) V / l_rms^3 with the root mean square of the six edges (Parthasarathy, Graichen and
/// Hathaway, Finite Elements in Analysis and Design 15, 1994); hexahedra: scaled Jacobian, the smallest
/// determinant of the three unit edges over the eight corners (Knupp, Int. J. Numer. Meth. Eng. 48, 2000).
std::vector<double> shape_qualities(const Mesh& mesh);

/// Mirrors the numbering of every cell whose determinant is negative throughout; returns how many there were.
std::int32_t turn_reversed_cells(Mesh& mesh);

}  // namespace tissu
