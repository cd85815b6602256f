#pragma once

/// Blades with one bend through a body of 8 x 6 x 4 cells, and what they leave of it in closed form.

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "cut_body.h"

namespace tissu::bends {

using Random = std::mt19937_64;
using Point = Eigen::Vector2d;

inline const Vec3 kSize(8, 6, 4);  ///< of the body; the edges of its cells are 1
inline constexpr double kReach = 15.0;

inline double real(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Two half-planes at a ridge through the point `at` of the x y plane, along z or leaning.
struct Bend {
  double degrees;
  Point at;
  double ahead;  ///< direction between the two walls
  Vec3 ridge;

  [[nodiscard]] std::array<Point, 3> line() const {
    const double half = 0.5 * degrees * std::numbers::pi / 180.0;
    const auto along = [&](double angle) -> Point {
      return kReach * Point(std::cos(angle), std::sin(angle));
    };
    return {at - along(ahead - half), at, at + along(ahead + half)};
  }
};

inline Bend random_bend(Random& random, bool leans) {
  Bend bend{real(random, 10.0, 90.0),
            {real(random, 2.0, 6.0), real(random, 2.0, 4.0)},
            real(random, 0.0, 2.0 * std::numbers::pi),
            Vec3(0, 0, 1)};
  if (leans) bend.ridge += Vec3(real(random, -0.6, 0.6), real(random, -0.6, 0.6), 0.0);
  return bend;
}

/// What a line leaves of a convex polygon on its left.
inline std::vector<Point> left_of(const std::vector<Point>& polygon, const Point& from, const Point& to) {
  const auto height = [&](const Point& p) {
    return (to - from)[0] * (p - from)[1] - (to - from)[1] * (p - from)[0];
  };
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const double of_a = height(a);
    const double of_b = height(b);
    if (of_a >= 0.0) kept.push_back(a);
    if (of_a * of_b < 0.0) kept.emplace_back(a + of_a / (of_a - of_b) * (b - a));
  }
  return kept;
}

/// Area on the inner side of a bend that does not lean: the walls turn to the left.
inline double inner_area(const Bend& bend) {
  std::vector<Point> polygon{{0, 0}, {kSize[0], 0}, {kSize[0], kSize[1]}, {0, kSize[1]}};
  const auto [a, b, c] = bend.line();
  polygon = left_of(left_of(polygon, a, b), b, c);
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * (p[0] * q[1] - p[1] * q[0]);
  }
  return sum;
}

/// The sheet z = 2 of quads, or of triangles.
inline Mesh sheet(CellType type, double jitter, Random& random) {
  Mesh mesh;
  const auto nx = static_cast<int>(kSize[0]);
  const auto ny = static_cast<int>(kSize[1]);
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const bool inner = i > 0 && i < nx && j > 0 && j < ny;
      const double dx = inner ? real(random, -jitter, jitter) : 0.0;
      const double dy = inner ? real(random, -jitter, jitter) : 0.0;
      mesh.positions.insert(mesh.positions.end(), {i + dx, j + dy, 0.5 * kSize[2]});
    }
  }
  CellBlock block{type, {}};
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const std::int32_t a = j * (nx + 1) + i;
      if (type == CellType::quad) {
        block.nodes.insert(block.nodes.end(), {a, a + 1, a + nx + 2, a + nx + 1});
      } else {
        block.nodes.insert(block.nodes.end(), {a, a + 1, a + nx + 2, a, a + nx + 2, a + nx + 1});
      }
    }
  }
  mesh.blocks.push_back(std::move(block));
  return mesh;
}

struct Carrier {
  CellType type;
  bool divide;
  [[nodiscard]] bool thin() const { return type == CellType::triangle || type == CellType::quad; }
  [[nodiscard]] std::string name() const {
    return std::string(info(type).name) + (divide ? " divided" : " copied");
  }
};
inline constexpr std::array<Carrier, 6> kCarriers{{{CellType::tetra, false},
                                                   {CellType::hexahedron, false},
                                                   {CellType::tetra, true},
                                                   {CellType::triangle, false},
                                                   {CellType::quad, false},
                                                   {CellType::triangle, true}}};

inline Mesh mesh_of(const Carrier& carrier, std::uint64_t seed) {
  Random random(seed);
  const double jitter = seed % 2 == 0 ? 0.0 : 0.15;
  if (carrier.thin()) return sheet(carrier.type, jitter, random);
  return test::typed_box(carrier.type, kSize, {8, 6, 4}, carrier.type == CellType::tetra ? jitter : 0.0,
                         seed);
}

/// What the cut may be beside the blade: crossings go to ends of edges within t0, and at the ridge the faces
/// of the cut are chords as long as a cell's longest edge.
inline double tolerance(const Bend& bend, const Carrier& carrier) {
  const double depth = carrier.thin() ? 1.0 : kSize[2];
  const double walls = 2.0 * std::hypot(kSize[0], kSize[1]);
  const double longest = carrier.thin() ? std::sqrt(2.0) : std::sqrt(3.0);
  const double half = 0.5 * bend.degrees * std::numbers::pi / 180.0;
  return depth * (walls * (carrier.divide ? 0.2 : 0.02) + 0.25 * longest * longest * std::tan(half));
}

}  // namespace tissu::bends
