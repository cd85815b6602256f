#include "edit/cut/cells_along.h"

#include <algorithm>

#include "tissu/base/crossing.h"
#include "tissu/base/exact.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

/// Whether a point is in a tetrahedron, its border included.
bool holds(const Patch& patch, const Patch::Tetra& tetra, const Vec3& point) {
  return std::ranges::all_of(kOpposite, [&](const auto& face) {
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return patch.vertex(tetra.vertices[face[i]]).place;
    };
    return orientation(corner(0), corner(1), corner(2), point) <= 0;
  });
}

bool passes(const Patch& patch, const Patch::Tetra& tetra, const std::array<Vec3, 2>& segment) {
  const auto& [a, b] = segment;
  const auto place = [&](std::size_t i) -> const Vec3& { return patch.vertex(tetra.vertices[i]).place; };
  if (tetra.corners() == 2) return false;
  if (tetra.corners() == 3) return crosses(a, b, {place(0), place(1), place(2)});
  return holds(patch, tetra, a) || std::ranges::any_of(kOpposite, [&](const auto& face) {
           return crosses(a, b, {place(face[0]), place(face[1]), place(face[2])});
         });
}

}  // namespace

std::vector<std::int32_t> cells_along(const Patch& patch, std::span<const std::array<Vec3, 2>> segments) {
  std::vector<std::int32_t> cells;
  if (segments.empty()) return cells;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    if (std::ranges::any_of(segments, [&](const auto& one) { return passes(patch, tetra, one); }))
      cells.push_back(tetra.cell);
  }
  sort_unique(cells);
  return cells;
}

}  // namespace tissu
