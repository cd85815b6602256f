#include "edit/repair/shift.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "edit/repair/shape.h"

namespace tissu {
namespace {

constexpr std::array kShares{1.0, 0.5, 0.25, 0.125};  ///< of a way
constexpr double kOutside = 1e-9;                     ///< a weight of a corner so far below 0 is rounding

/// The least quality at rest of the cells at a node, were it at a place.
double least_at(const RepairMesh& mesh, std::int32_t node, const Vec3& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t number : mesh.cells_at(node)) {
    const RepairCell cell = mesh.cell(number);
    CellCorners corners = rest_corners(mesh, cell);
    corners[place_in(cell, node)] = place;
    least = std::min(least, tetra_quality(corners));
  }
  return least;
}

/// The place at rest as weights of the corners of the cell at a node that has it.
std::optional<Rider> locate(const RepairMesh& mesh, std::int32_t node, const Vec3& place) {
  for (const std::int32_t number : mesh.cells_at(node)) {
    const RepairCell cell = mesh.cell(number);
    const CellCorners corners = rest_corners(mesh, cell);
    const double whole = tetra_volume(corners);
    Rider rider;
    double sum = 0.0;
    double least = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      CellCorners part = corners;
      part[i] = place;
      const double weight = tetra_volume(part) / whole;
      least = std::min(least, weight);
      rider.node[i] = cell.nodes[i];
      rider.weight[i] = std::max(weight, 0.0);
      sum += rider.weight[i];
    }
    if (!(least >= -kOutside)) continue;
    for (double& weight : rider.weight) weight /= sum;
    rider.count = 4;
    return rider;
  }
  return std::nullopt;
}

std::vector<Vec3> ways(const RepairMesh& mesh, std::int32_t number, std::int32_t node) {
  const Vec3 from = mesh.rest(node);
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (const std::int32_t other : mesh.cells_at(node)) {
    for (const std::int32_t one : mesh.cell(other).nodes) {
      if (one == node) continue;
      sum += mesh.rest(one) - from;
      count += 1.0;
    }
  }
  const RepairCell cell = mesh.cell(number);
  const std::size_t own = place_in(cell, node);
  const Vec3 a = mesh.rest(cell.nodes[(own + 1) % 4]);
  const Vec3 b = mesh.rest(cell.nodes[(own + 2) % 4]);
  const Vec3 c = mesh.rest(cell.nodes[(own + 3) % 4]);
  Vec3 normal = (b - a).cross(c - a).normalized();
  if (normal.dot(from - a) < 0.0) normal = -normal;
  const Vec3 away = 0.5 * (b - a).norm() * normal;
  const Vec3 mean = sum / count;
  return {mean, away, mean + away};
}

}  // namespace

std::vector<Operation> shifts_of(const RepairMesh& mesh, std::int32_t number,
                                 const std::vector<char>& may_move) {
  std::vector<Operation> found;
  for (const std::int32_t node : mesh.cell(number).nodes) {
    if (may_move[static_cast<std::size_t>(node)] == 0 || !mesh.is_solid(node) || !mesh.border(node).empty())
      continue;
    const Vec3 from = mesh.rest(node);
    double least = least_at(mesh, node, from);
    std::optional<Vec3> best;
    for (const Vec3& way : ways(mesh, number, node)) {
      for (const double share : kShares) {
        const Vec3 place = from + share * way;
        const double then = least_at(mesh, node, place);
        if (!(then > least)) continue;
        least = then;
        best = place;
      }
    }
    const auto to = best ? locate(mesh, node, *best) : std::nullopt;
    if (!to) continue;
    const auto cells = mesh.cells_at(node);
    Operation& operation = found.emplace_back(
        Operation{.kind = Repair::move, .patch = {cells.begin(), cells.end()}, .move = NodeMove{node, *to}});
    for (const std::int32_t cell : cells) operation.after.emplace_back(cell, mesh.cell(cell));
  }
  return found;
}

}  // namespace tissu
