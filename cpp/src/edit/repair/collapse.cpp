#include "edit/repair/collapse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "edit/repair/links.h"

namespace tissu {
namespace {

constexpr double kOutOfPlane = 1e-12;  ///< of an edge: rounding of places

using Triangle = std::array<std::int32_t, 3>;

/// Whether the surface stays where it is, and its opened faces among them.
bool keeps_surface(const RepairMesh& mesh, std::int32_t u, std::int32_t v) {
  const std::vector<RepairMesh::Face> border = mesh.border(u);
  if (border.empty()) return true;
  const Vec3 place = mesh.rest(u);
  const Vec3 way = mesh.rest(v) - place;
  std::vector<bool> beside;
  bool some = false;
  bool all = true;
  for (const auto& [others, cut] : border) {
    const auto [a, b] = others;
    const Vec3 normal = (mesh.rest(a) - place).cross(mesh.rest(b) - place).normalized();
    if (!(std::abs(normal.dot(way)) <= kOutOfPlane * way.norm())) return false;
    if (a == v || b == v) beside.push_back(cut);
    some = some || cut;
    all = all && cut;
  }
  if (beside.size() != 2) return false;
  if (some == all) return true;
  if (beside[0] == beside[1]) return false;
  // The border of the cut goes on straight on the other side of the node.
  std::map<std::int32_t, std::vector<bool>> at;
  for (const auto& [others, cut] : border) {
    for (const std::int32_t other : others) at[other].push_back(cut);
  }
  int ends = 0;
  for (const auto& [other, cut] : at) {
    if (cut.size() != 2 || cut[0] == cut[1]) continue;
    ++ends;
    const Vec3 back = mesh.rest(other) - place;
    if (!(back.cross(way).norm() <= kOutOfPlane * back.norm() * way.norm())) return false;
  }
  return ends == 2;
}

Triangle face_without(const RepairCell& cell, std::size_t f, std::int32_t u, std::int32_t v) {
  Triangle face{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i != f) face[count++] = cell.nodes[i] == u ? v : cell.nodes[i];
  }
  std::ranges::sort(face);
  return face;
}

}  // namespace

std::optional<Operation> collapse(const RepairMesh& mesh, std::int32_t u, std::int32_t v) {
  if (!keeps_surface(mesh, u, v) || !may_contract(mesh, u, v)) return std::nullopt;
  const auto cells = mesh.cells_at(u);
  Operation operation{.kind = Repair::collapse, .patch = {cells.begin(), cells.end()}};
  std::set<Triangle> cut;  // faces of the cells between u and v, as they are afterwards
  for (const std::int32_t number : cells) {
    const RepairCell cell = mesh.cell(number);
    const std::size_t to = place_in(cell, v);
    if (to == 4) continue;
    const std::size_t from = place_in(cell, u);
    const Triangle kept = face_without(cell, from, u, v);
    if (cell.is_cut(to)) return std::nullopt;
    Triangle moved{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != to) moved[count++] = cell.nodes[i];
    }
    if (mesh.cells_with(moved).size() != 2) return std::nullopt;
    if (cell.is_cut(from)) cut.insert(kept);
  }
  for (const std::int32_t number : cells) {
    RepairCell cell = mesh.cell(number);
    if (place_in(cell, v) < 4) continue;
    for (std::size_t f = 0; f < 4; ++f) {
      if (cell.nodes[f] != u && cut.contains(face_without(cell, f, u, v)))
        cell.cut |= static_cast<std::uint8_t>(1U << f);
    }
    cell.nodes[place_in(cell, u)] = v;
    operation.after.emplace_back(number, cell);
  }
  if (operation.after.empty()) return std::nullopt;
  return operation;
}

}  // namespace tissu
