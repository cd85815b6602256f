#include "tissu/mesh/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tissu {
namespace {

using Nodes = std::span<const std::int32_t>;

/// Signs of the corners of the hexahedron [-1, 1]^3.
constexpr std::array<std::array<int, 3>, 8> kCorners{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// The three neighbours of each corner of a hexahedron, right-handed.
constexpr std::array<std::array<std::uint8_t, 3>, 8> kNeighbours{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

constexpr std::array<std::pair<std::uint8_t, std::uint8_t>, 6> kTetraEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

double tetra_jacobian(const Mesh& mesh, Nodes cell) {
  const Vec3 x = mesh.node(cell[0]);
  return determinant(mesh.node(cell[1]) - x, mesh.node(cell[2]) - x, mesh.node(cell[3]) - x);
}

/// det(dx/dxi) of the trilinear map N_a = prod_i (1 + xi_i xi_ai) / 8 at xi.
double hexahedron_jacobian(const Mesh& mesh, Nodes cell, const Vec3& xi) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < 8; ++a) {
    const Vec3 sign(kCorners[a][0], kCorners[a][1], kCorners[a][2]);
    const Vec3 g = Vec3::Ones() + sign.cwiseProduct(xi);
    const Vec3 gradient(sign[0] * g[1] * g[2], g[0] * sign[1] * g[2], g[0] * g[1] * sign[2]);
    J += mesh.node(cell[a]) * gradient.transpose() / 8.0;
  }
  return J.determinant();
}

/// The determinants at the 2x2x2 Gauss points, whose weights are all 1.
std::array<double, 8> gauss_jacobians(const Mesh& mesh, Nodes cell) {
  std::array<double, 8> result{};
  for (std::size_t q = 0; q < 8; ++q)
    result[q] = hexahedron_jacobian(
        mesh, cell, Vec3(kCorners[q][0], kCorners[q][1], kCorners[q][2]) * std::numbers::inv_sqrt3);
  return result;
}

double volume(const Mesh& mesh, CellType type, Nodes cell) {
  if (type == CellType::tetra) return tetra_jacobian(mesh, cell) / 6.0;
  double sum = 0.0;
  for (const double jacobian : gauss_jacobians(mesh, cell)) sum += jacobian;
  return sum;
}

JacobianRange jacobian_range(const Mesh& mesh, CellType type, Nodes cell) {
  if (type == CellType::tetra) {
    const double jacobian = tetra_jacobian(mesh, cell);
    return {jacobian, jacobian};
  }
  const auto [smallest, largest] = std::ranges::minmax(gauss_jacobians(mesh, cell));
  return {smallest, largest};
}

double tetra_quality(const Mesh& mesh, Nodes cell) {
  double squares = 0.0;
  for (const auto& [a, b] : kTetraEdges) squares += (mesh.node(cell[a]) - mesh.node(cell[b])).squaredNorm();
  if (squares == 0.0) return 0.0;
  return std::numbers::sqrt2 * tetra_jacobian(mesh, cell) / std::pow(squares / 6.0, 1.5);
}

double scaled_jacobian(const Mesh& mesh, Nodes cell) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::array<Vec3, 3> edge;
    for (std::size_t i = 0; i < 3; ++i)  // normalized() leaves a zero edge zero
      edge[i] = (mesh.node(cell[kNeighbours[corner][i]]) - mesh.node(cell[corner])).normalized();
    smallest = std::min(smallest, determinant(edge[0], edge[1], edge[2]));
  }
  return smallest;
}

double shape_quality(const Mesh& mesh, CellType type, Nodes cell) {
  return type == CellType::tetra ? tetra_quality(mesh, cell) : scaled_jacobian(mesh, cell);
}

/// One value of `measure` for each cell of the mesh.
template <class Measure>
auto for_each_cell(const Mesh& mesh, Measure measure) {
  std::vector<decltype(measure(mesh, CellType{}, Nodes{}))> result;
  result.reserve(static_cast<std::size_t>(mesh.cell_count()));
  for (const CellBlock& block : mesh.blocks)
    for (std::int32_t i = 0; i < block.size(); ++i)
      result.push_back(measure(mesh, block.type, block.cell(i)));
  return result;
}

/// Mirrors a cell: two corners of a tetrahedron, or bottom and top of a hexahedron, change places.
void mirror(CellType type, std::span<std::int32_t> cell) {
  if (type == CellType::tetra)
    std::swap(cell[2], cell[3]);
  else
    std::swap_ranges(cell.begin(), cell.begin() + 4, cell.begin() + 4);
}

}  // namespace

std::vector<double> volumes(const Mesh& mesh) { return for_each_cell(mesh, volume); }

std::vector<JacobianRange> jacobian_ranges(const Mesh& mesh) { return for_each_cell(mesh, jacobian_range); }

std::vector<double> shape_qualities(const Mesh& mesh) { return for_each_cell(mesh, shape_quality); }

std::int32_t turn_reversed_cells(Mesh& mesh) {
  std::int32_t count = 0;
  for (CellBlock& block : mesh.blocks) {
    const auto width = static_cast<std::size_t>(info(block.type).nodes);
    for (std::int32_t i = 0; i < block.size(); ++i) {
      if (!(jacobian_range(mesh, block.type, block.cell(i)).largest < 0.0)) continue;
      mirror(block.type, std::span(block.nodes).subspan(static_cast<std::size_t>(i) * width, width));
      ++count;
    }
  }
  return count;
}

}  // namespace tissu
