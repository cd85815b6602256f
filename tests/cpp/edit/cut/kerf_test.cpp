/// The surface of cut bodies as contact meets it: walls are apart, and nothing crosses.

#include "edit/cut/kerf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "cut_body.h"
#include "tissu/base/crossing.h"

namespace tissu {
namespace {

constexpr double kRoundOff = 1e-14;

using Triangle = std::array<std::int32_t, 3>;

/// Places of the vertices of a surface.
std::map<std::int32_t, Vec3> places(const KerfSurface& surface, ConstReals x) {
  std::map<std::int32_t, Vec3> found;
  for (const Triangle& triangle : surface.triangles) {
    for (const std::int32_t v : triangle) {
      if (v >= 0) found[v] = block(x, v);
    }
  }
  for (const auto& [vertex, rider] : surface.carried) found[vertex] = rider.at(x);
  return found;
}

double volume(const KerfSurface& surface, ConstReals x) {
  const auto points = places(surface, x);
  double sum = 0.0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += points.at(a).dot(points.at(b).cross(points.at(c))) / 6.0;
  return sum;
}

/// Every edge has as many triangles along it as against it.
bool is_closed(const KerfSurface& surface) {
  std::map<std::array<std::int32_t, 2>, int> sums;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[i];
      const std::int32_t b = t[(i + 1) % 3];
      sums[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::ranges::all_of(sums, [](const auto& one) { return one.second == 0; });
}

/// Edges that go through triangles with which they share no vertex.
int crossings(const KerfSurface& surface, ConstReals x) {
  const auto points = places(surface, x);
  std::set<std::array<std::int32_t, 2>> edges;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.insert({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    }
  }
  int count = 0;
  for (const auto& [a, b] : edges) {
    for (const Triangle& t : surface.triangles) {
      if (std::ranges::find(t, a) != t.end() || std::ranges::find(t, b) != t.end()) continue;
      if (crosses(points.at(a), points.at(b), {points.at(t[0]), points.at(t[1]), points.at(t[2])})) ++count;
    }
  }
  return count;
}

TEST(KerfTest, ABodyThatNoBladeMetHasItsBoundary) {
  const test::CutBody body(test::typed_box(CellType::hexahedron, Vec3(2, 1, 1), {2, 1, 1}, 0.0, 1));
  const KerfSurface surface = kerf_surface(body.hosts, body.material, 0.1);
  EXPECT_EQ(surface.triangles.size(), 20U);
  EXPECT_TRUE(surface.carried.empty());
  EXPECT_TRUE(is_closed(surface));
  EXPECT_NEAR(volume(surface, body.x), 2.0, kRoundOff);
}

/// A cut through the middle of cells: each wall stands a depth inside its half, and its rim on the sides.
TEST(KerfTest, WallsOfAFlatCutStandTwoDepthsApart) {
  constexpr double kDepth = 0.004;
  for (const CellType type : {CellType::tetra, CellType::hexahedron, CellType::wedge}) {
    test::CutBody body(test::typed_box(type, Vec3(1, 1, 1), {3, 3, 3}, 0.0, 1));
    body.cut(body.plane(Vec3(0, 0, 0.48), Vec3(0, 0, 1)));
    const KerfSurface surface = kerf_surface(body.hosts, body.material, kDepth);
    EXPECT_TRUE(is_closed(surface));
    EXPECT_EQ(crossings(surface, body.x), 0);
    int walls = 0;
    for (const auto& [vertex, place] : places(surface, body.x)) {
      if (std::abs(place.z() - 0.48) > 0.1) continue;
      EXPECT_NEAR(std::abs(place.z() - 0.48), kDepth, kRoundOff);
      for (const double side : {place.x(), place.y()}) {
        EXPECT_GE(side, -kRoundOff);
        EXPECT_LE(side, 1.0 + kRoundOff);
      }
      ++walls;
    }
    EXPECT_GE(walls, 32);
    EXPECT_NEAR(volume(surface, body.x), 1.0 - 2.0 * kDepth, 1e-3 * kDepth);
  }
}

/// A cut to the middle: walls are apart but for the front, where they share their vertices.
TEST(KerfTest, TheFrontOfACutStaysWhereItIs) {
  test::CutBody body(test::typed_box(CellType::tetra, Vec3(1, 1, 1), {4, 4, 4}, 0.0, 1));
  const std::array<double, 12> corners = {-1, -1, 0.4, 0.5, -1, 0.4, 0.5, 2, 0.4, -1, 2, 0.4};
  const std::array<std::array<std::int32_t, 3>, 2> blade = {{{0, 1, 2}, {0, 2, 3}}};
  body.cut(triangle_sweep(corners, blade));
  ASSERT_EQ(body.piece_count(), 1U);
  const KerfSurface coincident = kerf_surface(body.hosts, body.material, 0.0);
  const KerfSurface surface = kerf_surface(body.hosts, body.material, 0.002);
  EXPECT_GT(crossings(coincident, body.x), 0);  // what touches counts
  EXPECT_EQ(crossings(surface, body.x), 0);
  EXPECT_TRUE(is_closed(surface));
  const auto before = places(coincident, body.x);
  int front = 0;
  for (const auto& [vertex, place] : places(surface, body.x)) {
    if (std::abs(before.at(vertex).z() - 0.4) > 1e-9) continue;
    if ((place - before.at(vertex)).norm() == 0.0) {
      EXPECT_GT(place.x(), 0.2);
      ++front;
    }
  }
  EXPECT_GE(front, 5);
}

/// A plane, or a disc, through the inside of the box.
Sweep random_blade(std::mt19937_64& random, const test::CutBody& body, int number) {
  std::uniform_real_distribution<double> in(0.2, 0.8);
  std::normal_distribution<double> any;
  const Vec3 point(in(random), in(random), in(random));
  const Vec3 normal(any(random), any(random), any(random));
  return number == 1 ? disc_sweep(point, normal, 0.3 + in(random)) : body.plane(point, normal);
}

/// Bent bodies, cut again and again at random, with cells taken out that leave hinges.
TEST(KerfTest, NothingCrossesAfterACutAndLittleAfterCutsThatCross) {
  constexpr double kDepth = 2e-3;
  constexpr double kNotFlat = 5e-3;
  int parted = 0;
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    std::mt19937_64 random(seed);
    const CellType type = std::array{CellType::tetra, CellType::hexahedron, CellType::wedge}[seed % 3];
    test::CutBody body(test::typed_box(type, Vec3(1, 1, 1), {2, 2, 2}, 0.2, seed));
    body.move([](const Vec3& p) {
      return Vec3(p.x() + 0.15 * p.y() * p.y(), 1.1 * p.y() - 0.1 * p.z() * p.x(), p.z() + 0.1 * p.x());
    });
    for (int cut = 0; cut < 3; ++cut) {
      body.cut(random_blade(random, body, cut));
      if (cut == 1 && seed % 4 == 0) body.ablate({body.hosts.numbers()[seed % 5]});
      const KerfSurface surface = kerf_surface(body.hosts, body.material, kDepth);
      ASSERT_TRUE(is_closed(surface)) << seed << " " << cut;
      const int many = crossings(surface, body.x);
      // Where walls cross walls a vertex may have no way in: such a cut is refused in a body that touches.
      if (cut == 0) {
        ASSERT_EQ(many, 0) << seed;
      } else {
        refused += many > 0 ? 1 : 0;
      }
      // Inside its material by a depth at most along its walls, beside hinges by a depth along their faces.
      const double met = volume(surface, body.hosts.rest());
      const double walls = body.cut_area() + (seed % 4 == 0 ? 2.0 : 0.0);
      // Quads of jittered cells are not flat: their halves are others than those of the material.
      ASSERT_LE(met, body.volume() + kNotFlat) << seed << " " << cut;
      ASSERT_GE(met, body.volume() - 4.0 * kDepth * walls - kNotFlat) << seed << " " << cut;
      parted += surface.carried.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(parted, 50);
  EXPECT_LE(refused, 1);  // of 60
}

/// Beside the lines where cuts meet, cells leave flat tetrahedra. One that turned over would lay a wall
/// through another.
TEST(KerfTest, FlatTetrahedraWhereCutsMeetDoNotTurnOver) {
  constexpr double kDepth = 4e-3;
  int cuts = 0;
  int crossed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> any;
    const CellType type = std::array{CellType::tetra, CellType::hexahedron, CellType::wedge}[seed % 3];
    test::CutBody body(test::typed_box(type, Vec3(1, 1, 1), {2, 2, 2}, 0.0, seed));
    for (int cut = 0; cut < 3; ++cut) {
      const Vec3 point = Vec3(0.5, 0.5, 0.5) + 0.15 * Vec3(any(random), any(random), any(random));
      body.cut(body.plane(point, Vec3(any(random), any(random), any(random))));
      ++cuts;
      crossed += crossings(kerf_surface(body.hosts, body.material, kDepth), body.x) > 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(cuts, 180);
  EXPECT_EQ(crossed, 0);
}

}  // namespace
}  // namespace tissu
