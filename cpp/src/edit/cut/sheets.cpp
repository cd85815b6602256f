#include "edit/cut/sheets.h"

#include <algorithm>
#include <initializer_list>
#include <numeric>
#include <tuple>

#include "tissu/base/index.h"

namespace tissu {
namespace {

using Box = Eigen::AlignedBox3d;
using Place = std::array<double, 3>;

Place place(const Vec3& p) { return {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}; }  // -0 is 0

/// A triangle or a segment, and what planes leave of it: each adds a corner at most.
struct Polygon {
  std::array<Vec3, 9> corner;
  std::size_t count = 0;

  void add(const Vec3& p) { corner[count++] = p; }
};

/// What is left of a convex polygon on the inner side of a plane across an axis.
Polygon clipped(const Polygon& polygon, int axis, double limit, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3& a = polygon.corner[i];
    const Vec3& b = polygon.corner[(i + 1) % polygon.count];
    const double of_a = sign * (limit - a[axis]);
    const double of_b = sign * (limit - b[axis]);
    if (of_a >= 0.0) kept.add(a);
    if ((of_a > 0.0 && of_b < 0.0) || (of_a < 0.0 && of_b > 0.0))
      kept.add(a + of_a / (of_a - of_b) * (b - a));
  }
  return kept;
}

/// Clips a polygon in its place. A plane that cuts nothing off leaves it as it is.
void clip(Polygon& polygon, int axis, double limit, double sign) {
  const auto first = polygon.corner.begin();
  const auto end = first + static_cast<std::ptrdiff_t>(polygon.count);
  const auto is_inside = [&](const Vec3& p) { return sign * (limit - p[axis]) >= 0.0; };
  if (!std::ranges::all_of(first, end, is_inside)) polygon = clipped(polygon, axis, limit, sign);
}

/// Whether a triangle, or a segment, and a box share a point. No plane cuts off a corner inside the box.
bool meets(std::initializer_list<Vec3> corners, const Box& box) {
  if (std::ranges::any_of(corners, [&](const Vec3& p) { return box.contains(p); })) return true;
  Polygon polygon;
  for (const Vec3& p : corners) polygon.add(p);
  for (int axis = 0; axis < 3 && polygon.count > 0; ++axis) {
    clip(polygon, axis, box.max()[axis], 1.0);
    clip(polygon, axis, box.min()[axis], -1.0);
  }
  return polygon.count > 0;
}

}  // namespace

BladeSheets::BladeSheets(const SweepPart& part) : part_(part) {
  using Edge = std::tuple<Place, Place, std::int32_t, std::int32_t>;
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    Box& box = boxes_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      box.extend(part.triangles[t][i]);
      const auto [low, high] =
          std::minmax({place(part.triangles[t][i]), place(part.triangles[t][(i + 1) % 3])});
      edges.emplace_back(low, high, static_cast<std::int32_t>(t), static_cast<std::int32_t>(i));
    }
  }
  std::ranges::sort(edges);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const auto& [a, b, triangle, side] = edges[i];
    const auto& [c, d, other, unused] = edges[i + 1];
    if (a == c && b == d) seams_.push_back({triangle, other, side});
  }
  std::ranges::sort(seams_, {}, &Seam::triangle);
}

BladeSheets::Inside BladeSheets::in(const Box& box) const {
  std::vector<std::int32_t> all(part_.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return in(box, all);
}

BladeSheets::Inside BladeSheets::in(const Box& box, std::span<const std::int32_t> triangles) const {
  Inside inside;
  for (const std::int32_t t : triangles) {
    const auto& corner = part_.triangles[at(t)];
    if (boxes_[at(t)].intersects(box) && meets({corner[0], corner[1], corner[2]}, box))
      inside.triangles.push_back(t);
  }
  std::vector<std::int32_t> root(inside.triangles.size());
  std::iota(root.begin(), root.end(), 0);
  const auto first = [&](std::int32_t i) {
    while (root[at(i)] != i) i = root[at(i)];
    return i;
  };
  const auto index = [&](std::int32_t t) -> std::int32_t {
    const auto found = std::ranges::lower_bound(inside.triangles, t);
    if (found == inside.triangles.end() || *found != t) return -1;
    return static_cast<std::int32_t>(found - inside.triangles.begin());
  };
  for (const std::int32_t t : inside.triangles) {
    for (const Seam& seam : std::ranges::equal_range(seams_, t, {}, &Seam::triangle)) {
      const std::int32_t other = index(seam.other);
      const auto& corner = part_.triangles[at(t)];
      const std::size_t i = at(seam.side);
      if (other < 0 || !meets({corner[i], corner[(i + 1) % 3]}, box)) continue;
      const auto [low, high] = std::minmax({first(index(t)), first(other)});
      root[at(high)] = low;
    }
  }
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto own = static_cast<std::int32_t>(i);
    inside.sheet.push_back(first(own) == own ? inside.count++ : inside.sheet[at(first(own))]);
  }
  return inside;
}

std::int32_t BladeSheets::Inside::of(std::int32_t triangle) const {
  const auto found = std::ranges::lower_bound(triangles, triangle);
  if (found == triangles.end() || *found != triangle) return -1;
  return sheet[static_cast<std::size_t>(found - triangles.begin())];
}

std::vector<std::int32_t> BladeSheets::Inside::members(std::int32_t number) const {
  std::vector<std::int32_t> list;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (sheet[i] == number) list.push_back(triangles[i]);
  }
  return list;
}

}  // namespace tissu
