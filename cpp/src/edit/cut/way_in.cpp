#include "edit/cut/way_in.h"

#include <algorithm>

namespace tissu {
namespace {

constexpr double kWanted = 0.2;  ///< cosine between the way in and a wall's normal that is looked for, …
constexpr double kLeast = 0.03;  ///< … and that is enough
constexpr double kRoundOff = 1e-9;
constexpr int kRounds = 200;
constexpr double kFurther = 1.2;  ///< than onto the plane that is hurt most

/// How far a way is from going inwards by `least`: the cosine that is missing most, and the normal.
struct Missing {
  double much = 0.0;
  Vec3 normal = Vec3::Zero();
  void look(const Vec3& along, const Vec3& unit, double least) {
    const double missing = along.dot(unit) + least;
    if (missing > much) {
      much = missing;
      normal = unit;
    }
  }
};

/// The method of relaxation for linear inequalities (Agmon 1954, Canadian Journal of Mathematics 6, 382-392),
/// on ways of length 1: away from each wall by `wanted`, by `least` at any rate.
std::optional<WayIn> relaxed(std::span<const Vec3> walls, std::span<const Vec3> others, double wanted,
                             double least) {
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (const Vec3& wall : walls) {
    sum += wall;
    area += wall.norm();
  }
  if (!(sum.norm() > kRoundOff * area)) return std::nullopt;
  Vec3 along = -sum.normalized();
  for (int round = 0; round < kRounds; ++round) {
    Missing worst;
    for (const Vec3& wall : walls) worst.look(along, wall.normalized(), wanted);
    for (const Vec3& other : others) worst.look(along, other, 0.0);
    if (!(worst.much > kRoundOff)) break;
    along -= kFurther * worst.much * worst.normal;
    if (!(along.norm() > kRoundOff)) return std::nullopt;
    along.normalize();
  }
  double gain = 0.0;
  for (const Vec3& wall : walls) {
    if (!(along.dot(wall) < -least * wall.norm())) return std::nullopt;
    gain -= along.dot(wall) / area;
  }
  const auto leaves = [&](const Vec3& other) { return along.dot(other) > kRoundOff; };
  if (!(gain > kLeast) || std::ranges::any_of(others, leaves)) return std::nullopt;
  return WayIn{along, 1.0 / gain};
}

}  // namespace

std::optional<WayIn> way_in(std::span<const Vec3> walls, std::span<const Vec3> others) {
  if (walls.empty()) {
    walls = others;
    others = {};
  }
  if (const auto way = relaxed(walls, others, kWanted, kLeast); way) return way;
  // Where the front of a cut lies on a wall of another, the way in leads along the front.
  return relaxed(walls, others, 0.0, -kRoundOff);
}

}  // namespace tissu
