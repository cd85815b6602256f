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

/// Volume of each cell [m3], negative when it is inside out: the sum of the determinants over the full rule
/// of the cell type, exact for straight edges.
std::vector<double> volumes(const Mesh& mesh);

/// Over the points of the full rule, where forces are evaluated. A linear tetrahedron has one: 6 V; the
/// reference hexahedron is [-1, 1]^3.
std::vector<JacobianRange> jacobian_ranges(const Mesh& mesh);

/// Shape of each cell, by its corners: 1 is ideal, 0 flat, negative inside out.
/// Tetrahedra: 6 sqrt(2) V / l_rms^3 with the root mean square of the six edges (Parthasarathy, Graichen and
/// Hathaway, Finite Elements in Analysis and Design 15, 1994); others: scaled Jacobian, the smallest
/// determinant of the three unit edges over the corners (Knupp, Int. J. Numer. Meth. Eng. 48, 2000), over
/// that of a cube; of a wedge between equilateral triangles, sqrt(3) / 2; of a pyramid of equal edges, 1 /
/// sqrt(2), and at most 1: the apex, where four edges meet, is left out.
std::vector<double> shape_qualities(const Mesh& mesh);

/// Mirrors the numbering of every cell whose determinant is negative throughout; returns how many there were.
std::int32_t turn_reversed_cells(Mesh& mesh);

}  // namespace tissu
