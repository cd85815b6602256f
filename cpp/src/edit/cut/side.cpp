#include "edit/cut/side.h"

#include <cmath>
#include <limits>

#include "tissu/base/exact.h"
#include "tissu/mesh/triangle_tree.h"

namespace tissu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEqual = 1e-9;                 ///< relative difference of distances that are equal
constexpr double kBeyond = 1.0 + 4.0 * kEqual;  ///< times the square of a distance: surely farther

std::array<double, 9> numbers(const std::array<Vec3, 3>& t) {
  return {t[0][0], t[0][1], t[0][2], t[1][0], t[1][1], t[1][2], t[2][0], t[2][1], t[2][2]};
}

Vec3 unit_normal(const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

/// Square of the distance to the box of a triangle: the square of that to the triangle is at least as large.
double box_square(const std::array<Vec3, 3>& t, const Vec3& p) {
  const Vec3 low = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
  const Vec3 high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

double distance(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  return (p - closest_on_triangle(p, numbers(triangle).data())).norm();
}

}  // namespace

double distance(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p) {
  double least = kInfinity;
  for (const std::int32_t t : triangles) {
    least = std::min(least, distance(part.triangles[static_cast<std::size_t>(t)], p));
  }
  return least;
}

bool is_beyond_border(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p) {
  double least = kInfinity;
  bool on_border = false;
  for (const std::int32_t t : triangles) {
    const auto& triangle = part.triangles[static_cast<std::size_t>(t)];
    const Vec3 nearest = closest_on_triangle(p, numbers(triangle).data());
    const double away = (p - nearest).norm();
    if (away > least * (1.0 + kEqual)) continue;
    if (away < least * (1.0 - kEqual)) on_border = false;
    least = std::min(least, away);
    for (std::size_t i = 0; i < 3; ++i) {
      if ((part.border[static_cast<std::size_t>(t)] >> i & 1U) == 0) continue;
      const Vec3 along = triangle[(i + 1) % 3] - triangle[i];
      const Vec3 off = along.cross(nearest - triangle[i]);
      on_border = on_border || off.norm() <= kEqual * along.squaredNorm();
    }
  }
  return on_border;
}

double signed_height(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p) {
  double least = kInfinity;
  double height = 0.0;
  int sign = 0;
  for (const std::int32_t t : triangles) {
    const auto& triangle = part.triangles[static_cast<std::size_t>(t)];
    if (box_square(triangle, p) > kBeyond * least * least) continue;
    const double away = distance(triangle, p);
    if (away > least * (1.0 + kEqual)) continue;
    const double above = std::abs(unit_normal(triangle).dot(p - triangle[0]));
    if (away >= least * (1.0 - kEqual) && above <= height) continue;
    least = std::min(least, away);
    height = above;
    sign = orientation(triangle[0], triangle[1], triangle[2], p);
  }
  return sign * height;
}

NearestPlace nearest_place(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p) {
  double least = kInfinity;
  NearestPlace nearest{p, Vec3::Zero()};
  for (const std::int32_t t : triangles) {
    const auto& triangle = part.triangles[static_cast<std::size_t>(t)];
    if (box_square(triangle, p) > least * least) continue;
    const Vec3 place = closest_on_triangle(p, numbers(triangle).data());
    const double away = (p - place).norm();
    if (away >= least) continue;
    least = away;
    nearest = {place, unit_normal(triangle), t};
  }
  return nearest;
}

}  // namespace tissu
