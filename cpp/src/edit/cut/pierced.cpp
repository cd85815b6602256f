#include "edit/cut/pierced.h"

#include <algorithm>
#include <array>
#include <span>

#include "tissu/base/crossing.h"
#include "tissu/base/exact.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/mesh/triangle_tree.h"

namespace tissu {
namespace {

using Triangle = std::array<Vec3, 3>;
using Numbers = std::span<const std::int32_t>;

constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// A tetrahedron, or a triangle of a sheet, now.
class Solid {
 public:
  Solid(const Patch& patch, const Patch::Tetra& tetra) : corners_(tetra.corners()) {
    for (std::size_t i = 0; i < corners_; ++i) corner_[i] = patch.vertex(tetra.vertices[i]).place;
  }

  /// Whether one of its edges crosses a triangle.
  [[nodiscard]] bool is_crossed(const Triangle& triangle) const {
    return std::ranges::any_of(kEdges, [&](const auto& edge) {
      return edge[1] < corners_ && crosses(corner_[edge[0]], corner_[edge[1]], triangle);
    });
  }

  /// Calls with the two ends of each edge of a triangle that enters it, of those that the bits of `sides`
  /// name.
  template <class Visit>
  void each_entry(const Triangle& triangle, unsigned sides, const Visit& visit) const {
    if (sides == 0 || corners_ == 2 || is_beside(triangle)) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& from = triangle[i];
      const Vec3& to = triangle[(i + 1) % 3];
      if ((sides >> i & 1U) != 0 && holds(from, to)) visit(from, to);
    }
  }

  /// The middle of what it holds of a segment.
  [[nodiscard]] Vec3 middle(const Vec3& from, const Vec3& to) const {
    if (corners_ == 3) {
      const Vec3 normal = (corner_[1] - corner_[0]).cross(corner_[2] - corner_[0]);
      const double a = normal.dot(from - corner_[0]);
      const double b = normal.dot(to - corner_[0]);
      return from + (a != b ? std::clamp(a / (a - b), 0.0, 1.0) : 0.5) * (to - from);
    }
    double low = 0.0;
    double high = 1.0;
    for (const auto& face : kOpposite) {
      const Vec3& c = corner_[face[0]];
      const Vec3 out = (corner_[face[1]] - c).cross(corner_[face[2]] - c);
      const double a = out.dot(from - c);
      const double b = out.dot(to - c);
      if (a < b) high = std::min(high, -a / (b - a));
      if (a > b) low = std::max(low, a / (a - b));
    }
    return from + 0.5 * (std::clamp(low, 0.0, 1.0) + std::clamp(high, 0.0, 1.0)) * (to - from);
  }

 private:
  [[nodiscard]] bool is_beside(const Triangle& triangle) const {
    int above = 0;
    int below = 0;
    for (std::size_t i = 0; i < corners_; ++i) {
      const int side = orientation(triangle[0], triangle[1], triangle[2], corner_[i]);
      above += side > 0 ? 1 : 0;
      below += side < 0 ? 1 : 0;
    }
    return above == static_cast<int>(corners_) || below == static_cast<int>(corners_);
  }

  /// Whether a point of a segment is in it.
  [[nodiscard]] bool holds(const Vec3& from, const Vec3& to) const {
    if (corners_ == 3) return crosses(from, to, {corner_[0], corner_[1], corner_[2]});
    const auto outside = [&](const auto& face) {
      return orientation(corner_[face[0]], corner_[face[1]], corner_[face[2]], from) > 0;
    };
    if (std::ranges::none_of(kOpposite, outside)) return true;
    return std::ranges::any_of(kOpposite, [&](const auto& face) {
      return crosses(from, to, {corner_[face[0]], corner_[face[1]], corner_[face[2]]});
    });
  }

  std::size_t corners_;
  std::array<Vec3, 4> corner_;
};

bool is_met(const Patch::Tetra& tetra, const OnCut& known) {
  return std::ranges::any_of(tetra.vertices,
                             [&](std::int32_t v) { return v >= 0 && (known.on(v) || known[v].wall); });
}

/// Sides of a triangle that are not on the border of the blade.
unsigned seams(const SweepPart& part, std::int32_t triangle) {
  return ~unsigned{part.border[at(triangle)]} & 7U;
}

/// The nearest point of a face of the cut, a segment of it or a single vertex.
Vec3 nearest(std::span<const Vec3> on, const Vec3& p) {
  if (on.size() == 1) return on[0];
  if (on.size() == 2) {
    const Vec3 along = on[1] - on[0];
    const double square = along.squaredNorm();
    return on[0] + (square > 0.0 ? std::clamp(along.dot(p - on[0]) / square, 0.0, 1.0) : 0.0) * along;
  }
  const std::array<double, 9> corners{on[0][0], on[0][1], on[0][2], on[1][0], on[1][1],
                                      on[1][2], on[2][0], on[2][1], on[2][2]};
  return closest_on_triangle(p, corners.data());
}

/// Whether this blade opened a face of a tetrahedron near a place.
bool is_near_opened(const Patch& patch, const OnCut& known, const Patch::Tetra& tetra, const Vec3& place,
                    double reach) {
  for (std::size_t f = 0; f < tetra.corners(); ++f) {
    if ((tetra.cut >> f & 1U) == 0) continue;
    std::vector<Vec3> corners;
    bool all_on = true;
    for (const std::uint8_t i : kOpposite[f]) {
      if (tetra.vertices[i] < 0) continue;
      all_on = all_on && known.on(tetra.vertices[i]);
      corners.push_back(patch.vertex(tetra.vertices[i]).place);
    }
    if (all_on && (nearest(corners, place) - place).norm() <= reach) return true;
  }
  return false;
}

/// Whether the border of the blade is so near that the front of the cut may lag behind it.
bool is_near_border(const SweepPart& part, const Vec3& place, double reach) {
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if ((part.border[t] >> i & 1U) == 0) continue;
      const std::array<Vec3, 2> ends{part.triangles[t][i], part.triangles[t][(i + 1) % 3]};
      if ((nearest(ends, place) - place).norm() <= reach) return true;
    }
  }
  return false;
}

/// Whether the cut follows the blade where this enters a tetrahedron at a place: vertices on the cut lie
/// near, or faces that the blade opened.
bool is_followed(const Patch& patch, const SweepPart& part, const OnCut& known, const Patch::Tetra& tetra,
                 const Vec3& place, double share) {
  const double reach = share * patch.cell(tetra.cell).size;
  const std::span<const std::int32_t> vertices(tetra.vertices.data(), tetra.corners());
  std::vector<Vec3> on;
  for (const std::int32_t v : vertices) {
    if (known[v].before || known[v].wall) return true;
    if (known.on(v)) on.push_back(patch.vertex(v).place);
  }
  if (on.size() == 4 || (!on.empty() && (nearest(on, place) - place).norm() <= reach)) return true;
  if (is_near_border(part, place, patch.cell(tetra.cell).size)) return true;
  return std::ranges::any_of(vertices, [&](std::int32_t v) {
    return std::ranges::any_of(patch.tetrahedra_at(v), [&](std::int32_t t) {
      return is_near_opened(patch, known, patch.tetra(t), place, reach);
    });
  });
}

}  // namespace

std::vector<std::int32_t> pierced_tetrahedra(const Patch& patch, const SweepPart& part, const NearCells& near,
                                             const OnCut& known, bool in_whole_cells) {
  std::vector<std::int32_t> pierced;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    const Patch::Cell& cell = patch.cell(tetra.cell);
    if (in_whole_cells && (cell.divided || cell.opened)) continue;
    const Numbers triangles = near.triangles(cell.number);
    if (triangles.empty() || is_met(tetra, known)) continue;
    const Solid solid(patch, tetra);
    bool entered = false;
    for (const std::int32_t number : triangles) {
      solid.each_entry(part.triangles[at(number)], 7U, [&](const Vec3&, const Vec3&) { entered = true; });
      if (entered) break;
    }
    if (entered) pierced.push_back(static_cast<std::int32_t>(t));
  }
  return pierced;
}

std::vector<std::int32_t> cells_pierced_between(const Patch& patch, const Blade& blade, const OnCut& known,
                                                double share) {
  std::vector<std::int32_t> cells;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    const Numbers triangles = blade.crowded.triangles(tetra.cell);
    if (triangles.empty()) continue;
    const Solid solid(patch, tetra);
    bool pierced = false;
    for (const std::int32_t t : triangles) {
      solid.each_entry(blade.part.triangles[at(t)], seams(blade.part, t), [&](const Vec3& a, const Vec3& b) {
        pierced = pierced || !is_followed(patch, blade.part, known, tetra, solid.middle(a, b), share);
      });
    }
    // Where the ridge of a sheet passes an edge to and fro within t0, the cut leaves it out.
    const auto crosses_edge = [&](std::int32_t t) { return solid.is_crossed(blade.part.triangles[at(t)]); };
    if (!pierced || (!is_met(tetra, known) && std::ranges::any_of(triangles, crosses_edge))) continue;
    cells.push_back(tetra.cell);
  }
  sort_unique(cells);
  return cells;
}

}  // namespace tissu
