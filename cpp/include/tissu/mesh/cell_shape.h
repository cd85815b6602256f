#pragma once

/// How each cell type is built: its edges, its faces, its mirror image.

#include <array>
#include <cstdint>
#include <span>

#include "tissu/mesh/mesh.h"

namespace tissu {

/// A face of a cell: node numbers within the cell, the corners anticlockwise seen from outside, then the
/// middle of each edge from corner c to corner c + 1, then the middle of the face.
struct LocalFace {
  int corners;  ///< 3 or 4
  int nodes;    ///< 3, 4; 6, 8; 9
  std::array<std::uint8_t, 9> node;
};

/// The faces of a cell type; a sheet and a line have none.
std::span<const LocalFace> faces(CellType type);

/// The corners that end each edge, in the order of the nodes in the middles of the edges.
std::span<const std::array<std::uint8_t, 2>> edges(CellType type);

/// For each node of a cell, the node that takes its place in the mirror image of the cell's numbering.
std::span<const std::uint8_t> mirrored(CellType type);

}  // namespace tissu
