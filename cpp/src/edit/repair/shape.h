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

/// The least of the measures of a cell over the bounds below which it is bad: so it is bad below 1. Bounds
/// are `below` for q and 3 rho_in / rho_out, and twice this for the shortest edge over the longest.
double worst_measure(const CellCorners& corners, double below);

}  // namespace tissu
