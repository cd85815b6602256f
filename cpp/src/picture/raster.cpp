#include "tissu/picture/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "tissu/base/vec.h"

namespace tissu {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kSteep = 1e-12;  ///< of a normal: seen on edge

/// Numbers of the pixels whose middles lie from `from` up to `to`.
std::pair<std::int64_t, std::int64_t> middles(double from, double to, std::int64_t size) {
  const auto number = [size](double at) {
    return static_cast<std::int64_t>(std::clamp(std::ceil(at - 0.5), 0.0, static_cast<double>(size)));
  };
  return {number(from), number(to)};
}

struct Triangle {
  std::array<Vec3, 3> at;       ///< in the order given
  std::array<Vec3, 3> ordered;  ///< by the points' numbers
  /// nearness = plane[0] + plane[1] column + plane[2] row
  [[nodiscard]] Vec3 plane() const {
    Vec3 normal = (at[1] - at[0]).cross(at[2] - at[0]);
    if (std::abs(normal.z()) < kSteep * std::max(normal.cwiseAbs().maxCoeff(), 1e-300)) {
      normal = Vec3::UnitZ();
    }
    const double a = -normal.x() / normal.z();
    const double b = -normal.y() / normal.z();
    return {at[0].z() - a * at[0].x() - b * at[0].y(), a, b};
  }
  /// Where the row of middles at y enters and leaves.
  [[nodiscard]] std::pair<double, double> span(double y) const {
    double left = kFar;
    double right = -kFar;
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}, {0, 2}}) {
      const Vec3& a = ordered[i];
      const Vec3& b = ordered[j];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    return {left, right};
  }
  [[nodiscard]] Vec3 weights(double x, double y) const {
    const Vec3 u = at[1] - at[0];
    const Vec3 v = at[2] - at[0];
    double area = u.x() * v.y() - u.y() * v.x();
    if (std::abs(area) < 1e-300) area = 1e-300;
    const double wx = x - at[0].x();
    const double wy = y - at[0].y();
    const double second = std::clamp((wx * v.y() - wy * v.x()) / area, 0.0, 1.0);
    const double third = std::clamp((u.x() * wy - u.y() * wx) / area, 0.0, 1.0);
    const Vec3 all(std::clamp(1.0 - second - third, 0.0, 1.0), second, third);
    return all / all.sum();
  }
};

Triangle triangle_of(std::span<const double> corners, std::span<const std::int64_t> triangles,
                     std::size_t number) {
  std::array<std::int64_t, 3> nodes{};
  std::copy_n(triangles.begin() + static_cast<std::ptrdiff_t>(3 * number), 3, nodes.begin());
  Triangle triangle;
  for (std::size_t k = 0; k < 3; ++k) triangle.at[k] = block(corners, static_cast<std::int32_t>(nodes[k]));
  std::ranges::sort(nodes);
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.ordered[k] = block(corners, static_cast<std::int32_t>(nodes[k]));
  }
  return triangle;
}

/// The triangle seen at each pixel, -1: none; and how near it is.
struct Buffer {
  std::int64_t width;
  std::int64_t height;
  std::vector<double> nearest;
  std::vector<std::int64_t> owner;

  void draw(const Triangle& triangle, std::int64_t number) {
    for (const Vec3& corner : triangle.at) {
      if (!corner.allFinite()) return;
    }
    const auto [low, high] = std::minmax({triangle.at[0].y(), triangle.at[1].y(), triangle.at[2].y()});
    const auto [back, front] = std::minmax({triangle.at[0].z(), triangle.at[1].z(), triangle.at[2].z()});
    const Vec3 plane = triangle.plane();
    const auto [top, bottom] = middles(low, high, height);
    for (std::int64_t row = top; row < bottom; ++row) {
      const double y = static_cast<double>(row) + 0.5;
      const auto [left, right] = triangle.span(y);
      if (!(right > left)) continue;
      const auto [first, last] = middles(left, right, width);
      for (std::int64_t column = first; column < last; ++column) {
        const double x = static_cast<double>(column) + 0.5;
        const double z = std::clamp(plane[0] + plane[1] * x + plane[2] * y, back, front);
        const auto pixel = static_cast<std::size_t>(row * width + column);
        if (z < nearest[pixel]) continue;
        nearest[pixel] = z;
        owner[pixel] = number;
      }
    }
  }
};

}  // namespace

Seen rasterise(std::span<const double> corners, std::span<const std::int64_t> triangles, std::int64_t width,
               std::int64_t height) {
  const auto pixels = static_cast<std::size_t>(width * height);
  Buffer buffer{width, height, std::vector<double>(pixels, -kFar), std::vector<std::int64_t>(pixels, -1)};
  for (std::size_t t = 0; t < triangles.size() / 3; ++t) {
    buffer.draw(triangle_of(corners, triangles, t), static_cast<std::int64_t>(t));
  }
  Seen seen;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    if (buffer.owner[pixel] < 0) continue;
    const auto at = static_cast<std::int64_t>(pixel);
    const Triangle triangle = triangle_of(corners, triangles, static_cast<std::size_t>(buffer.owner[pixel]));
    const std::int64_t row = at / width;
    const std::int64_t column = at % width;
    const Vec3 weights = triangle.weights(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    seen.pixel.push_back(at);
    seen.triangle.push_back(buffer.owner[pixel]);
    seen.weights.insert(seen.weights.end(), weights.data(), weights.data() + 3);
    seen.nearness.push_back(buffer.nearest[pixel]);
  }
  return seen;
}

}  // namespace tissu
