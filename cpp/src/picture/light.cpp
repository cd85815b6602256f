#include "tissu/picture/light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tissu/base/vec.h"

namespace tissu {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kEdge = 0.45;       ///< by which an edge is darker
constexpr double kBrightest = 1.18;  ///< of the colour of what faces the viewer
constexpr double kGloss = 0.14;

/// Lights in the axes of the picture: right, top, towards the viewer.
struct Lights {
  Vec3 key = Vec3(-0.45, 0.60, 0.66).normalized();
  Vec3 fill = Vec3(0.80, 0.05, 0.60).normalized();
  Vec3 half = (key + Vec3::UnitZ()).normalized();
  double facing = brightness(Vec3::UnitZ());

  /// Of a white surface: wrapped key light, fill light and light from above.
  [[nodiscard]] double brightness(const Vec3& normal) const {
    const double wrapped = std::max((normal.dot(key) + 0.35) / 1.35, 0.0);
    const double side = std::max(normal.dot(fill), 0.0);
    return 0.60 * wrapped + 0.26 * side + 0.34 + 0.08 * normal.y();
  }
  /// The cosine to the power of forty.
  [[nodiscard]] double gloss(const Vec3& normal) const {
    const double c = std::max(normal.dot(half), 0.0);
    const double c8 = (c * c) * (c * c) * (c * c) * (c * c);
    const double c16 = c8 * c8;
    return c8 * c16 * c16;
  }
};

/// The normal of a seen pixel, towards the viewer; one without length points there.
Vec3 normal_at(std::span<const double> normals, std::int64_t triangle, const Vec3& weights, double towards) {
  const Eigen::Map<const Mat3> corners(&normals[static_cast<std::size_t>(9 * triangle)]);
  Vec3 normal = corners * weights;
  if (towards < 0.0) normal = -normal;
  normal.z() = std::max(normal.z(), 0.0);  // smoothed past the rim
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
}

/// Row of the table for a value.
std::size_t row_of(const Paint& paint, double value) {
  const std::size_t parts = paint.table.size() / 3 - 3;
  const auto count = static_cast<double>(parts);
  const double at = paint.high > paint.low ? (value - paint.low) / (paint.high - paint.low) * count : 0.0;
  if (std::isnan(at)) return parts + 2;
  if (at < 0.0) return parts;
  if (at > count) return parts + 1;
  return std::min(static_cast<std::size_t>(at), parts - 1);
}

Vec3 colour_at(const Paint& paint, std::int64_t triangle, const Vec3& weights) {
  if (paint.values.empty()) return {paint.colour[0], paint.colour[1], paint.colour[2]};
  const double value = block(paint.values, static_cast<std::int32_t>(triangle)).dot(weights);
  return block(paint.table, static_cast<std::int32_t>(row_of(paint, value)));
}

}  // namespace

Canvas light(const Seen& seen, std::span<const double> normals, std::span<const double> towards,
             const Paint& paint, std::int64_t width, std::int64_t height) {
  const auto pixels = static_cast<std::size_t>(width * height);
  Canvas canvas{width, height, std::vector<double>(3 * pixels, 0.0), std::vector<double>(pixels, -kFar)};
  const Lights lights;
  for (std::size_t i = 0; i < seen.pixel.size(); ++i) {
    const std::int64_t triangle = seen.triangle[i];
    const Vec3 weights = block(ConstReals(seen.weights), static_cast<std::int32_t>(i));
    const Vec3 normal = normal_at(normals, triangle, weights, towards[static_cast<std::size_t>(triangle)]);
    const double bright = std::clamp(lights.brightness(normal) / lights.facing, 0.0, kBrightest);
    const Vec3 lit =
        bright * colour_at(paint, triangle, weights) + Vec3::Constant(kGloss * lights.gloss(normal));
    const auto pixel = static_cast<std::size_t>(seen.pixel[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      canvas.colour[3 * pixel + k] = std::clamp(lit[static_cast<Eigen::Index>(k)], 0.0, 1.0);
    }
    canvas.nearness[pixel] = seen.nearness[i];
  }
  return canvas;
}

void darken_edges(double step, Canvas& canvas) {
  const auto w = static_cast<std::size_t>(canvas.width);
  const auto h = static_cast<std::size_t>(canvas.height);
  const std::vector<double>& near = canvas.nearness;
  // Second differences: a surface seen at a grazing angle is steep, but does not jump.
  const auto jumps = [&](std::size_t here, std::size_t apart) {
    const double before = near[here - apart];
    const double after = near[here + apart];
    if (before == -kFar || after == -kFar) return false;
    return std::abs(2.0 * near[here] - before - after) > step && near[here] > std::min(before, after);
  };
  for (std::size_t row = 0; row < h; ++row) {
    for (std::size_t column = 0; column < w; ++column) {
      const std::size_t here = row * w + column;
      if (near[here] == -kFar) continue;
      const bool down = row > 0 && row + 1 < h && jumps(here, w);
      const bool across = column > 0 && column + 1 < w && jumps(here, 1);
      if (!down && !across) continue;
      for (std::size_t k = 0; k < 3; ++k) canvas.colour[3 * here + k] *= 1.0 - kEdge;
    }
  }
}

std::vector<double> shown_pixels(std::span<const double> colour, std::span<const double> opacity,
                                 std::int64_t width, std::int64_t height, std::int64_t finer) {
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  const auto n = static_cast<std::size_t>(finer);
  const double share = 1.0 / static_cast<double>(finer * finer);
  std::vector<double> shown(4 * (w / n) * (h / n), 0.0);
  for (std::size_t row = 0; row < h / n * n; ++row) {
    for (std::size_t column = 0; column < w / n * n; ++column) {
      const std::size_t from = row * w + column;
      if (opacity[from] == 0.0) continue;
      double* const to = &shown[4 * (row / n * (w / n) + column / n)];
      for (std::size_t k = 0; k < 3; ++k) to[k] += opacity[from] * colour[3 * from + k];
      to[3] += opacity[from];
    }
  }
  for (std::size_t i = 0; i < shown.size(); i += 4) {
    if (shown[i + 3] == 0.0) continue;
    for (std::size_t k = 0; k < 3; ++k) shown[i + k] /= shown[i + 3];
    shown[i + 3] *= share;
  }
  return shown;
}

}  // namespace tissu
