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

/// A side of the surface. Two walls of a cut meet at its front, in one plane with opposite normals.
struct Side {
  Vec3 normal;  ///< outwards, of length 1
  bool cut;

  [[nodiscard]] bool goes_on_in(const Side& other) const {
    return cut == other.cut && normal.dot(other.normal) > 0.0 &&
           normal.cross(other.normal).norm() <= kOutOfPlane;
  }
};

Side side_of(const RepairMesh& mesh, std::int32_t u, const RepairMesh::Face& face) {
  const Vec3 place = mesh.rest(u);
  const auto [a, b] = face.others;
  const Vec3 normal = (mesh.rest(a) - place).cross(mesh.rest(b) - place).normalized();
  return {normal.dot(mesh.rest(face.behind) - place) > 0.0 ? Vec3(-normal) : normal, face.cut};
}

/// Whether the surface stays where it is, its opened faces among it, and fronts of cuts.
bool keeps_surface(const RepairMesh& mesh, std::int32_t u, std::int32_t v) {
  const std::vector<RepairMesh::Face> border = mesh.border(u);
  if (border.empty()) return true;
  const Vec3 place = mesh.rest(u);
  const Vec3 way = mesh.rest(v) - place;
  std::map<std::int32_t, std::vector<Side>> at;  // faces at each edge of the surface, by its other end
  for (const RepairMesh::Face& face : border) {
    const Side side = side_of(mesh, u, face);
    if (!(std::abs(side.normal.dot(way)) <= kOutOfPlane * way.norm())) return false;
    for (const std::int32_t other : face.others) at[other].push_back(side);
  }
  if (!at.contains(v)) return false;
  std::vector<std::int32_t> ridges;
  for (const auto& [other, sides] : at) {
    if (sides.size() != 2) return false;
    if (!sides[0].goes_on_in(sides[1])) ridges.push_back(other);
  }
  if (ridges.empty()) return true;
  if (ridges.size() != 2 || std::ranges::find(ridges, v) == ridges.end()) return false;
  const Vec3 back = mesh.rest(ridges[0] == v ? ridges[1] : ridges[0]) - place;
  return back.cross(way).norm() <= kOutOfPlane * back.norm() * way.norm();
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
