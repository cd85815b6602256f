#include "tissu/mesh/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tissu/element/reference_cell.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

using Nodes = std::span<const std::int32_t>;
using Corner = std::array<std::uint8_t, 4>;

/// A corner and its three neighbours, right-handed.
constexpr std::array<Corner, 8> kHexahedronCorners{{{0, 1, 3, 4},
                                                    {1, 2, 0, 5},
                                                    {2, 3, 1, 6},
                                                    {3, 0, 2, 7},
                                                    {4, 7, 5, 0},
                                                    {5, 4, 6, 1},
                                                    {6, 5, 7, 2},
                                                    {7, 6, 4, 3}}};
constexpr std::array<Corner, 6> kWedgeCorners{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
constexpr std::array<Corner, 4> kPyramidCorners{{{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};

/// The tables of the full rule of each cell type, made once.
const ReferenceCell& full_rule(CellType type) {
  static const std::vector<ReferenceCell> rules = [] {
    std::vector<ReferenceCell> all;
    for (const CellTypeInfo& row : cell_types()) all.push_back(reference_cell(row.name, "full"));
    return all;
  }();
  return rules[static_cast<std::size_t>(type)];
}

/// det(dx/dxi) at a point of the rule.
double jacobian(const Mesh& mesh, Nodes cell, const ReferenceCell::Point& point) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < cell.size(); ++a)
    J += mesh.node(cell[a]) * Eigen::Map<const Vec3>(point.gradients[a].data()).transpose();
  return J.determinant();
}

double volume(const Mesh& mesh, CellType type, Nodes cell) {
  double sum = 0.0;
  for (const auto& point : full_rule(type).points) sum += point.weight * jacobian(mesh, cell, point);
  return sum;
}

JacobianRange jacobian_range(const Mesh& mesh, CellType type, Nodes cell) {
  JacobianRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& point : full_rule(type).points) {
    const double value = jacobian(mesh, cell, point);
    range = {std::min(range.smallest, value), std::max(range.largest, value)};
  }
  return range;
}

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

double tetra_quality(const Mesh& mesh, Nodes cell) {
  double squares = 0.0;
  for (const auto& [a, b] : edges(CellType::tetra))
    squares += (mesh.node(cell[a]) - mesh.node(cell[b])).squaredNorm();
  if (squares == 0.0) return 0.0;
  const Vec3 x = mesh.node(cell[0]);
  const double six_volumes =
      determinant(mesh.node(cell[1]) - x, mesh.node(cell[2]) - x, mesh.node(cell[3]) - x);
  return std::numbers::sqrt2 * six_volumes / std::pow(squares / 6.0, 1.5);
}

double scaled_jacobian(const Mesh& mesh, Nodes cell, std::span<const Corner> corners) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Corner& corner : corners) {
    std::array<Vec3, 3> edge;
    for (std::size_t i = 0; i < 3; ++i)  // normalized() leaves a zero edge zero
      edge[i] = (mesh.node(cell[corner[i + 1]]) - mesh.node(cell[corner[0]])).normalized();
    smallest = std::min(smallest, determinant(edge[0], edge[1], edge[2]));
  }
  return smallest;
}

double shape_quality(const Mesh& mesh, CellType type, Nodes cell) {
  switch (info(type).corners) {
    case 4:
      return tetra_quality(mesh, cell);
    case 5:
      return std::min(1.0, std::numbers::sqrt2 * scaled_jacobian(mesh, cell, kPyramidCorners));
    case 6:
      return 2.0 * std::numbers::inv_sqrt3 * scaled_jacobian(mesh, cell, kWedgeCorners);
    default:
      return scaled_jacobian(mesh, cell, kHexahedronCorners);
  }
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

/// Mirrors a cell's numbering.
void mirror(CellType type, std::span<std::int32_t> cell) {
  const std::vector<std::int32_t> before(cell.begin(), cell.end());
  std::ranges::transform(mirrored(type), cell.begin(), [&](std::uint8_t node) { return before[node]; });
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
