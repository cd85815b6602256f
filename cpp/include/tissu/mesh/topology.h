#pragma once

/// How cells hang together: faces, the outer surface, connected parts.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/mesh/mesh.h"

namespace tissu {

/// A face of a cell: corner numbers within the cell, anticlockwise seen from outside.
struct LocalFace {
  int size;  ///< 3 or 4 corners
  std::array<std::uint8_t, 4> corners;
};

/// The faces of a cell type.
std::span<const LocalFace> faces(CellType type);

/// The faces that belong to one cell only, anticlockwise seen from outside, in the order of the cells.
struct Surface {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> triangle_cell;  ///< cell number across the blocks
  std::vector<std::array<std::int32_t, 4>> quads;
  std::vector<std::int32_t> quad_cell;
};

Surface boundary_surface(const Mesh& mesh);

/// Number of faces that more than two cells share: cells there overlap.
std::int32_t overfull_face_count(const Mesh& mesh);

/// Part number of each cell, from 0 in the order of the first cells; cells that share a node are in one part.
std::vector<std::int32_t> connected_parts(const Mesh& mesh);

}  // namespace tissu
