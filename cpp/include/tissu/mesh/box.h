#pragma once

/// A box filled with a regular grid of cells: the mesh of bars, beams and cubes.

#include <array>

#include "tissu/mesh/mesh.h"

namespace tissu {

/// How a grid cell, with corners numbered as a hexahedron, is filled.
enum class Split {
  none,         ///< one hexahedron
  six,          ///< six tetrahedra around the diagonal corner 0 - corner 6
  five,         ///< one inner tetrahedron and four corners, in two mirror images like a chessboard
  six_mirrored  ///< six, every cell the mirror image of its neighbours: symmetric about planes of even grids
};

/// A box with one corner at `origin` [m] and edges `size` [m], cut into `cells` along x, y, z.
/// Nodes are numbered x fastest, then y, then z; so are the grid cells.
/// Throws ParameterError when a size or a number of cells is not positive, or there are too many nodes.
Mesh box_mesh(const Vec3& origin, const Vec3& size, std::array<int, 3> cells, Split split);

}  // namespace tissu
