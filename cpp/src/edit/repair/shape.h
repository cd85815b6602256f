#pragma once

/// How far cells are from the regular tetrahedron.

#include <array>

#include "edit/repair/repair_mesh.h"

namespace tissu {

using CellCorners = std::array<Vec3, 4>;

CellCorners rest_corners(const RepairMesh& mesh, const RepairCell& cell);
CellCorners present_corners(const RepairMesh& mesh, const RepairCell& cell);

/// [m3]
double tetra_volume(const CellCorners& corners);
/// Of tetra_quality of the cutter.
double tetra_quality(const CellCorners& corners);

/// Measures of a cell over the bounds below which it is bad.
struct Badness {
  double worst = 1.0;      ///< the least of all; the cell is bad below 1
  bool has_short = false;  ///< of the shortest edge over the longest: type I
};
/// `below`: bound of q and of 3 rho_in / rho_out; twice it is that of the ratio of edges.
Badness badness(const CellCorners& corners, double below);

}  // namespace tissu
