#include "tissu/edit/cut/sweep.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

using Triangle = std::array<Vec3, 3>;
using Place = std::array<double, 3>;
using Corners = std::array<std::size_t, 3>;

constexpr std::size_t kDiscSides = 32;
/// Cosine between two ways of a blade one after the other: it turns back by more than 175 degrees.
constexpr double kTurnsBack = -0.9962;
constexpr double kRetraces = 1e-3;  ///< sine of the angle between a way back and the way there: they are one

Place place(const Vec3& p) { return {p[0], p[1], p[2]}; }

void check_finite(const Vec3& p, const char* what) {
  if (p.allFinite()) return;
  throw ParameterError("the " + std::string(what) + " of a blade is (" + number_text(p[0]) + ", " +
                       number_text(p[1]) + ", " + number_text(p[2]) +
                       "); three finite numbers are accepted.");
}

Vec3 unit(const Vec3& normal) {
  check_finite(normal, "normal");
  const double length = normal.stableNorm();
  if (!(length > 0.0)) throw ParameterError("the normal of a blade has no length; any other is accepted.");
  return (normal / length).eval();
}

/// Two unit vectors in the plane of a unit normal. Of an axis they are axes, so that points of the plane keep
/// its coordinate exactly.
std::pair<Vec3, Vec3> directions(const Vec3& normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 u = normal.cross(Vec3::Unit(least)).normalized();
  return {u, normal.cross(u)};
}

bool has_area(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]).squaredNorm() > 0.0; }

/// A triangle that stands twice in a list would cross every edge to and fro.
void erase_repeated(std::vector<Triangle>& triangles) {
  std::set<std::array<Place, 3>> seen;
  std::erase_if(triangles, [&](const Triangle& t) {
    std::array<Place, 3> corners = {place(t[0]), place(t[1]), place(t[2])};
    std::ranges::sort(corners);
    return !seen.insert(corners).second;
  });
}

/// The triangles on each edge, as triangle * 3 + the corner where the edge starts. Points are the same where
/// their coordinates are.
class EdgeTable {
 public:
  explicit EdgeTable(const std::vector<Triangle>& triangles) {
    std::map<Place, std::size_t> numbers;
    for (const Triangle& t : triangles) {
      Corners& corners = corners_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = numbers.try_emplace(place(t[i] + Vec3::Zero()), numbers.size()).first->second;
      }
    }
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) sides_[key(t, i)].push_back(3 * t + i);
    }
  }
  [[nodiscard]] const std::vector<std::size_t>& at(std::size_t triangle, std::size_t i) const {
    return sides_.at(key(triangle, i));
  }
  /// Whether two triangles run along a common edge in opposite directions, as neighbours turned alike do.
  [[nodiscard]] bool turned_alike(std::size_t side, std::size_t other) const {
    return corners_[side / 3][side % 3] != corners_[other / 3][other % 3];
  }

 private:
  [[nodiscard]] std::pair<std::size_t, std::size_t> key(std::size_t t, std::size_t i) const {
    return std::minmax({corners_[t][i], corners_[t][(i + 1) % 3]});
  }
  std::vector<Corners> corners_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> sides_;
};

/// Marks the edges that one triangle only has.
void mark_border(SweepPart& part) {
  const EdgeTable table(part.triangles);
  part.border.assign(part.triangles.size(), 0);
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (table.at(t, i).size() == 1) part.border[t] |= static_cast<std::uint8_t>(1U << i);
    }
  }
}

Sweep one_part(std::vector<Triangle> triangles, std::int32_t incision = -1) {
  std::erase_if(triangles, [](const Triangle& t) { return !has_area(t); });
  if (triangles.empty()) throw ParameterError("a blade has no area; a surface with an area is accepted.");
  SweepPart part{std::move(triangles), {}, incision, {}};
  mark_border(part);
  return {{std::move(part)}};
}

/// Turns and numbers one connected part from its first triangle on: +1 as it is, -1 turned round, 0: not in a
/// part yet. `members` get the triangles of the part.
void flood(const EdgeTable& table, std::size_t first, std::vector<int>& turn,
           std::vector<std::size_t>& members) {
  turn[first] = 1;
  members = {first};
  for (std::size_t next = 0; next < members.size(); ++next) {
    const std::size_t t = members[next];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& sides = table.at(t, i);
      if (sides.size() != 2) continue;
      const std::size_t other = sides[0] / 3 == t ? sides[1] : sides[0];
      const int wanted = table.turned_alike(3 * t + i, other) ? turn[t] : -turn[t];
      if (turn[other / 3] == 0) {
        turn[other / 3] = wanted;
        members.push_back(other / 3);
      } else if (turn[other / 3] != wanted) {
        throw ParameterError(
            "the triangles of a blade cannot be turned alike, as a strip with a twist; "
            "a surface with two sides is accepted.");
      }
    }
  }
}

}  // namespace

Sweep plane_sweep(const Vec3& point, const Vec3& normal, const Vec3& low, const Vec3& high) {
  check_finite(point, "point");
  const auto [u, v] = directions(unit(normal));
  const Eigen::AlignedBox3d box(low, high);
  const Vec3 n = unit(normal);
  const double half = 0.5 * box.sizes().dot(n.cwiseAbs()) * (1.0 + 1e-9);
  if (std::abs(n.dot(box.center() - point)) > half) return {};
  const Vec3 from = box.center() - point;
  const Vec3 middle = point + u * u.dot(from) + v * v.dot(from);
  const double r = 1.1 * box.sizes().norm();  // of the circle in the triangle
  const double side = 2.0 * std::numbers::sqrt3 * r;
  const Triangle triangle{middle - r * v - 0.5 * side * u, middle - r * v + 0.5 * side * u,
                          middle + 2.0 * r * v};
  return one_part({triangle});
}

Sweep disc_sweep(const Vec3& center, const Vec3& normal, double radius) {
  check_finite(center, "center");
  if (!(radius > 0.0) || !std::isfinite(radius)) {
    throw ParameterError("a disc has the radius " + number_text(radius) + " m; above 0 is accepted.");
  }
  const auto [u, v] = directions(unit(normal));
  std::array<Vec3, kDiscSides> rim;
  for (std::size_t i = 0; i < kDiscSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kDiscSides);
    rim[i] = center + radius * std::cos(angle) * u + radius * std::sin(angle) * v;
  }
  std::vector<Triangle> triangles;
  triangles.reserve(kDiscSides);
  for (std::size_t i = 0; i < kDiscSides; ++i)
    triangles.push_back({center, rim[i], rim[(i + 1) % kDiscSides]});
  return one_part(std::move(triangles));
}

Sweep triangle_sweep(std::span<const double> points, std::span<const std::array<std::int32_t, 3>> triangles) {
  const auto count = static_cast<std::int32_t>(points.size() / 3);
  std::vector<Triangle> all;
  for (const auto& t : triangles) {
    for (const std::int32_t p : t) {
      if (p < 0 || p >= count) {
        throw ParameterError("a triangle of a blade has the point " + std::to_string(p) + "; 0 to " +
                             std::to_string(count - 1) + " are accepted.");
      }
    }
    all.push_back({block(points, t[0]), block(points, t[1]), block(points, t[2])});
    for (const Vec3& p : all.back()) check_finite(p, "points");
  }
  std::erase_if(all, [](const Triangle& t) { return !has_area(t); });
  erase_repeated(all);
  if (all.empty()) throw ParameterError("a blade has no area; a surface with an area is accepted.");
  const EdgeTable table(all);
  std::vector<int> turn(all.size(), 0);
  std::vector<std::size_t> members;
  Sweep sweep;
  for (std::size_t first = 0; first < all.size(); ++first) {
    if (turn[first] != 0) continue;
    flood(table, first, turn, members);
    std::ranges::sort(members);
    SweepPart& part = sweep.parts.emplace_back();
    for (const std::size_t t : members) {
      if (turn[t] < 0) std::swap(all[t][1], all[t][2]);
      part.triangles.push_back(all[t]);
    }
    mark_border(part);
  }
  return sweep;
}

Sweep edge_sweep(std::span<const double> places, std::int32_t moments, std::int32_t points,
                 std::int32_t incision, std::int32_t past) {
  if (moments < 2 || points < 2 ||
      places.size() != 3 * static_cast<std::size_t>(moments) * static_cast<std::size_t>(points)) {
    throw ParameterError("a swept edge has " + std::to_string(points) + " points at " +
                         std::to_string(moments) + " moments and " + std::to_string(places.size() / 3) +
                         " places; at least 2 points at 2 moments with a place for each are accepted.");
  }
  const auto at = [&](std::int32_t moment, std::int32_t point) -> Vec3 {
    return block(places, moment * points + point);
  };
  // An edge of a cell that is crossed to and fro in almost one place is not cut: a way back along the way
  // there is a surface of its own.
  const auto way = [&](std::int32_t k) -> Vec3 {
    Vec3 sum = Vec3::Zero();
    for (std::int32_t i = 0; i < points; ++i) sum += at(k, i) - at(k - 1, i);
    return sum;
  };
  Sweep sweep;
  std::vector<Triangle> triangles;
  std::int32_t fresh = 0;
  const auto end_part = [&] {
    if (!triangles.empty()) {
      sweep.parts.push_back(std::move(one_part(std::move(triangles), incision).parts.front()));
      sweep.parts.back().fresh = fresh;
    }
    triangles.clear();
    fresh = 0;
  };
  const auto add = [&](const Triangle& triangle, bool known) {
    if (!has_area(triangle)) return;
    triangles.push_back(triangle);
    fresh += known ? 1 : 0;
  };
  const auto turn_back = [&](std::int32_t k) {
    end_part();
    if (sweep.parts.empty() ||
        way(k).cross(way(k - 1)).norm() <= kRetraces * way(k).norm() * way(k - 1).norm())
      return;
    for (std::int32_t i = 1; i < points; ++i)
      sweep.parts.back().corner.push_back({at(k - 1, i - 1), at(k - 1, i)});
  };
  for (std::int32_t k = 0; k < moments; ++k) {
    for (std::int32_t i = 0; i < points; ++i) check_finite(at(k, i), "places");
    if (k == 0) continue;
    if (k > 1 && way(k).dot(way(k - 1)) < kTurnsBack * way(k).norm() * way(k - 1).norm()) turn_back(k);
    for (std::int32_t i = 1; i < points; ++i) {
      const Vec3 a = at(k - 1, i - 1);
      const Vec3 b = at(k - 1, i);
      const Vec3 c = at(k, i);
      const Vec3 d = at(k, i - 1);
      add({a, b, c}, k < past);
      add({a, c, d}, k < past);
    }
  }
  end_part();
  if (sweep.parts.empty()) throw ParameterError("a blade has no area; a surface with an area is accepted.");
  return sweep;
}

}  // namespace tissu
