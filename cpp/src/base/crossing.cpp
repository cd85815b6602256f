#include "tissu/base/crossing.h"

#include <algorithm>
#include <cstddef>

#include "tissu/base/exact.h"

namespace tissu {
namespace {

using Triangle = std::array<Vec3, 3>;

/// Signs of which none is positive, or none negative.
bool agree(const std::array<int, 3>& signs) {
  const auto [low, high] = std::ranges::minmax_element(signs);
  return *low >= 0 || *high <= 0;
}

bool all_are(int sign, const std::array<int, 3>& signs) {
  return std::ranges::all_of(signs, [&](int one) { return one == sign; });
}

/// A segment in the plane of a triangle whose orientation, seen from `above`, is `turn`. Two convex shapes in
/// a plane that share no point are parted by a line along a side of one of them.
bool overlaps(const Vec3& a, const Vec3& b, const Triangle& triangle, const Vec3& above, int turn) {
  std::array<int, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = triangle[i];
    const Vec3& to = triangle[(i + 1) % 3];
    if (orientation(from, to, a, above) == -turn && orientation(from, to, b, above) == -turn) return false;
    sides[i] = orientation(a, b, from, above);
  }
  return !all_are(1, sides) && !all_are(-1, sides);
}

/// Seen from a point that lies off the plane along an axis, in which no triangle with an area lies for all
/// three.
bool crosses_in_plane(const Vec3& a, const Vec3& b, const Triangle& triangle) {
  double size = 0.0;
  for (const Vec3& corner : triangle) size = std::max(size, corner.cwiseAbs().maxCoeff());
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 above = triangle[0];
    above[axis] = above[axis] > 0.0 ? -size : size;
    const int turn = orientation(triangle[0], triangle[1], triangle[2], above);
    if (turn != 0) return overlaps(a, b, triangle, above, turn);
  }
  return false;  // a triangle without area
}

}  // namespace

bool crosses(const Vec3& a, const Vec3& b, const Triangle& triangle) {
  const int side_a = orientation(triangle[0], triangle[1], triangle[2], a);
  const int side_b = orientation(triangle[0], triangle[1], triangle[2], b);
  if (side_a == 0 && side_b == 0) return crosses_in_plane(a, b, triangle);
  if (side_a == side_b) return false;
  std::array<int, 3> turns{};
  for (std::size_t i = 0; i < 3; ++i) turns[i] = orientation(a, b, triangle[i], triangle[(i + 1) % 3]);
  return agree(turns);
}

}  // namespace tissu
