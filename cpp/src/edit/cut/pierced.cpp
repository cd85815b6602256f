#include "edit/cut/pierced.h"

#include <algorithm>
#include <array>
#include <span>

#include "tissu/base/crossing.h"
#include "tissu/base/exact.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

using Triangle = std::array<Vec3, 3>;
using Numbers = std::span<const std::int32_t>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

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

  /// Whether an edge of a triangle, of those that the bits of `sides` name, enters it.
  [[nodiscard]] bool is_entered(const Triangle& triangle, unsigned sides) const {
    if (sides == 0 || corners_ == 2 || is_beside(triangle)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if ((sides >> i & 1U) != 0 && holds(triangle[i], triangle[(i + 1) % 3])) return true;
    }
    return false;
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
  return std::ranges::any_of(tetra.vertices, [&](std::int32_t v) { return v >= 0 && known.on(v); });
}

/// Sides of a triangle that are not on the border of the blade.
unsigned seams(const SweepPart& part, std::int32_t triangle) {
  return ~unsigned{part.border[at(triangle)]} & 7U;
}

/// Whether a vertex of a tetrahedron is on the sheet of a triangle.
bool is_on_sheet(const Patch& patch, const Blade& blade, const OnCut& known, const Patch::Tetra& tetra,
                 std::int32_t triangle) {
  Eigen::AlignedBox3d box;
  const std::span<const std::int32_t> vertices(tetra.vertices.data(), tetra.corners());
  for (const std::int32_t v : vertices) {
    box.extend(patch.vertex(v).place);
    known.each_meeting(v, [&](const OnCut::Meeting& meeting) {
      if (meeting.on) box.extend(meeting.place);
    });
  }
  const BladeSheets::Inside inside = blade.sheets.in(box);
  bool on = false;
  for (const std::int32_t v : vertices) {
    on = on || known[v].before;
    known.each_meeting(v, [&](const OnCut::Meeting& meeting) {
      on = on || (meeting.on && inside.of(meeting.triangle) == inside.of(triangle));
    });
  }
  return on;
}

}  // namespace

std::vector<std::int32_t> pierced_tetrahedra(const Patch& patch, const SweepPart& part, const NearCells& near,
                                             const OnCut& known) {
  std::vector<std::int32_t> pierced;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    const Numbers triangles = near.triangles(patch.cell(tetra.cell).number);
    if (triangles.empty() || is_met(tetra, known)) continue;
    const Solid solid(patch, tetra);
    const auto enters = [&](std::int32_t number) { return solid.is_entered(part.triangles[at(number)], 7U); };
    if (std::ranges::any_of(triangles, enters)) pierced.push_back(static_cast<std::int32_t>(t));
  }
  return pierced;
}

std::vector<std::int32_t> cells_pierced_between(const Patch& patch, const Blade& blade, const OnCut& known) {
  std::vector<std::int32_t> cells;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    const Numbers triangles = blade.crowded.triangles(tetra.cell);
    if (triangles.empty()) continue;
    const Solid solid(patch, tetra);
    const auto crosses_edge = [&](std::int32_t t) { return solid.is_crossed(blade.part.triangles[at(t)]); };
    const auto is_pierced = [&](std::int32_t t) {
      return solid.is_entered(blade.part.triangles[at(t)], seams(blade.part, t)) &&
             !is_on_sheet(patch, blade, known, tetra, t);
    };
    // Where the ridge of a sheet passes an edge to and fro within t0, the cut leaves it out.
    if (!std::ranges::any_of(triangles, is_pierced) || std::ranges::any_of(triangles, crosses_edge)) continue;
    cells.push_back(tetra.cell);
  }
  sort_unique(cells);
  return cells;
}

}  // namespace tissu
