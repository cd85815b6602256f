#include "tissu/mesh/box.h"

#include <limits>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {
namespace {

using Corners = std::array<std::int32_t, 8>;
using Tetra = std::array<std::uint8_t, 4>;

/// Around the diagonal 0 - 6: each tetrahedron holds one edge of the hexagon 1 2 3 7 4 5.
constexpr std::array<Tetra, 6> kSix{
    {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};

/// Inner tetrahedron on corners 0 2 5 7; the mirror image has it on corners 1 3 4 6.
constexpr std::array<Tetra, 5> kFive{{{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 5, 7, 4}, {2, 7, 5, 6}, {0, 2, 7, 5}}};
constexpr std::array<Tetra, 5> kFiveMirrored{
    {{1, 0, 4, 3}, {1, 2, 3, 6}, {1, 5, 6, 4}, {3, 4, 6, 7}, {1, 3, 4, 6}}};

/// Corner numbers of a hexahedron mirrored in x, y, z.
constexpr std::array<Corners, 3> kMirror{
    {{1, 0, 3, 2, 5, 4, 7, 6}, {3, 2, 1, 0, 7, 6, 5, 4}, {4, 5, 6, 7, 0, 1, 2, 3}}};

struct Grid {
  std::array<int, 3> cells;

  std::int32_t node(int i, int j, int k) const { return i + (cells[0] + 1) * (j + (cells[1] + 1) * k); }

  Corners corners(int i, int j, int k) const {
    return {node(i, j, k),     node(i + 1, j, k),     node(i + 1, j + 1, k),     node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)};
  }
};

template <std::size_t n>
void append(const std::array<Tetra, n>& tetras, const Corners& corners, std::vector<std::int32_t>& nodes) {
  for (const Tetra& tetra : tetras)
    for (const std::uint8_t corner : tetra) nodes.push_back(corners[corner]);
}

/// An odd number of mirrors turns a tetrahedron inside out, so its last two corners change places.
void append_mirrored(const Corners& corners, std::array<int, 3> place, std::vector<std::int32_t>& nodes) {
  Corners mirrored = corners;
  bool odd = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (place[axis] % 2 == 0) continue;
    const Corners before = mirrored;
    for (std::size_t c = 0; c < 8; ++c) mirrored[c] = before[static_cast<std::size_t>(kMirror[axis][c])];
    odd = !odd;
  }
  for (Tetra tetra : kSix) {
    if (odd) std::swap(tetra[2], tetra[3]);
    for (const std::uint8_t corner : tetra) nodes.push_back(mirrored[corner]);
  }
}

void append_cell(const Grid& grid, std::array<int, 3> place, Split split, std::vector<std::int32_t>& nodes) {
  const Corners corners = grid.corners(place[0], place[1], place[2]);
  switch (split) {
    case Split::none:
      nodes.insert(nodes.end(), corners.begin(), corners.end());
      break;
    case Split::six:
      append(kSix, corners, nodes);
      break;
    case Split::five:
      append((place[0] + place[1] + place[2]) % 2 == 0 ? kFive : kFiveMirrored, corners, nodes);
      break;
    case Split::six_mirrored:
      append_mirrored(corners, place, nodes);
      break;
  }
}

std::vector<double> grid_positions(const Vec3& origin, const Vec3& size, std::array<int, 3> cells) {
  std::vector<double> positions;
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) {
        positions.push_back(origin.x() + size.x() * i / cells[0]);
        positions.push_back(origin.y() + size.y() * j / cells[1]);
        positions.push_back(origin.z() + size.z() * k / cells[2]);
      }
  return positions;
}

/// Numbers of nodes of cells are counted in 32 bits: at most six tetrahedra of four nodes per grid cell.
void require_box(const Vec3& size, std::array<int, 3> cells) {
  double nodes = 24.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(size[static_cast<Eigen::Index>(axis)] > 0.0) || cells[axis] < 1)
      throw ParameterError("a box needs positive edges and at least one cell along each axis");
    nodes *= cells[axis] + 1.0;
  }
  if (nodes > std::numeric_limits<std::int32_t>::max())
    throw ParameterError("a box of so many cells does not fit 32-bit numbers");
}

}  // namespace

Mesh box_mesh(const Vec3& origin, const Vec3& size, std::array<int, 3> cells, Split split) {
  require_box(size, cells);
  const Grid grid{cells};
  CellBlock block{split == Split::none ? CellType::hexahedron : CellType::tetra, {}};
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) append_cell(grid, {i, j, k}, split, block.nodes);
  return Mesh{grid_positions(origin, size, cells), {std::move(block)}};
}

}  // namespace tissu
