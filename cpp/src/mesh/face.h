#pragma once

/// Every face of every cell of a mesh, and which of them are the same.

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "tissu/mesh/cell_shape.h"
#include "tissu/mesh/mesh.h"

namespace tissu {

/// A face of the mesh: its corners in ascending order (a triangle ends in -1) name it whatever cell it is
/// seen from.
struct Face {
  std::array<std::int32_t, 4> key;
  std::int32_t cell;      ///< number across the blocks
  std::int32_t block;     ///< place of the cell's block
  std::uint8_t local;     ///< place among the faces of the cell's type
  std::uint8_t corners;   ///< 3 or 4
  std::int32_t in_block;  ///< place of the cell in its block
};

/// The faces cell by cell.
std::vector<Face> all_faces(const Mesh& mesh);

/// Node numbers of a face, as `LocalFace` orders them; -1 where there are fewer.
std::array<std::int32_t, 9> face_nodes(const Mesh& mesh, const Face& face);

/// Calls `visit` with the numbers of the faces of `all` that have the same corners.
template <class Visit>
void for_each_face(const std::vector<Face>& all, Visit visit) {
  std::vector<std::int32_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t f) -> const auto& { return all[static_cast<std::size_t>(f)].key; };
  std::ranges::stable_sort(order, {}, key);
  for (auto first = order.begin(); first != order.end();) {
    const auto last = std::find_if(first, order.end(), [&](std::int32_t f) { return key(f) != key(*first); });
    visit(std::span<const std::int32_t>(first, last));
    first = last;
  }
}

/// The faces that one cell only has, in the order of the cells.
std::vector<Face> boundary_faces(const Mesh& mesh);

}  // namespace tissu
