#include "tissu/edit/cut/sweep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tissu/base/error.h"

namespace tissu {
namespace {

double area(const Sweep& sweep) {
  double sum = 0.0;
  for (const SweepPart& part : sweep.parts) {
    for (const auto& t : part.triangles) sum += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  }
  return sum;
}

TEST(SweepTest, APlaneCoversTheBoxAndKeepsAnAxisExactly) {
  const Sweep sweep = plane_sweep(Vec3(0.1, 5, 5), Vec3(2, 0, 0), Vec3(0, 0, 0), Vec3(1, 2, 3));
  ASSERT_EQ(sweep.parts.size(), 1U);
  ASSERT_EQ(sweep.parts[0].triangles.size(), 1U);
  const auto& t = sweep.parts[0].triangles[0];
  const double whole = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  for (const Vec3& p : t) EXPECT_EQ(p[0], 0.1);
  for (const double y : {0.0, 2.0}) {
    for (const double z : {0.0, 3.0}) {  // a corner is inside when the three parts that it makes add up
      const Vec3 p(0.1, y, z);
      double parts = 0.0;
      for (std::size_t i = 0; i < 3; ++i) parts += 0.5 * (t[i] - p).cross(t[(i + 1) % 3] - p).norm();
      EXPECT_NEAR(parts, whole, 1e-12 * whole);
    }
  }
  EXPECT_TRUE(plane_sweep(Vec3(0, 0, 4), Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(1, 2, 3)).parts.empty());
}

TEST(SweepTest, ADiscHasItsPolygonsArea) {
  const double radius = 0.3;
  const Sweep sweep = disc_sweep(Vec3(1, 2, 3), Vec3(1, -2, 0.5), radius);
  EXPECT_NEAR(area(sweep), 16.0 * radius * radius * std::sin(std::numbers::pi / 16.0), 1e-15);
  for (const std::uint8_t border : sweep.parts[0].border) EXPECT_EQ(border, 0b010);  // the rim
}

/// A tent of two roofs whose second triangle is given the other way round, and one triangle apart.
TEST(SweepTest, TrianglesAreTurnedAlikeAndPartedByTheirEdges) {
  const std::array<double, 21> points{0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 5, 0, 0, 6, 0, 0, 5, 1, 0};
  const std::array<std::array<std::int32_t, 3>, 3> triangles{{{0, 1, 2}, {1, 2, 3}, {4, 5, 6}}};
  const Sweep sweep = triangle_sweep(points, triangles);
  ASSERT_EQ(sweep.parts.size(), 2U);
  const auto& roof = sweep.parts[0].triangles;
  ASSERT_EQ(roof.size(), 2U);
  const auto normal = [](const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]); };
  EXPECT_GT(normal(roof[0]).dot(normal(roof[1])), 0.0);
  EXPECT_NEAR(area(sweep), std::sqrt(2.0) + 0.5, 1e-15);
}

TEST(SweepTest, ASweptEdgeIsItsRuledSurface) {
  std::vector<double> places;
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) places.insert(places.end(), {0.5 * k, 0.25 * i, 0.0});
  }
  const Sweep sweep = edge_sweep(places, 4, 3, 2);
  EXPECT_NEAR(area(sweep), 1.5 * 0.5, 1e-15);
  EXPECT_EQ(sweep.parts[0].incision, 2);
}

TEST(SweepTest, BladesWithoutAreaOrWithOddNumbersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plane_sweep(Vec3(nan, 0, 0), Vec3(0, 0, 1), Vec3::Zero(), Vec3::Ones()), ParameterError);
  EXPECT_THROW(plane_sweep(Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Ones()), ParameterError);
  EXPECT_THROW(disc_sweep(Vec3::Zero(), Vec3(0, 0, 1), 0.0), ParameterError);
  EXPECT_THROW(disc_sweep(Vec3::Zero(), Vec3(0, 0, 1), nan), ParameterError);
  const std::array<double, 9> line{0, 0, 0, 1, 0, 0, 2, 0, 0};
  const std::array<std::array<std::int32_t, 3>, 1> one{{{0, 1, 2}}};
  EXPECT_THROW(triangle_sweep(line, one), ParameterError);
  const std::array<std::array<std::int32_t, 3>, 1> unknown{{{0, 1, 3}}};
  EXPECT_THROW(triangle_sweep(line, unknown), ParameterError);
  EXPECT_THROW(edge_sweep(line, 1, 3), ParameterError);
  const std::array<double, 12> still{0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0};
  EXPECT_THROW(edge_sweep(still, 2, 2), ParameterError);
}

/// A strip of triangles around a ring, its ends joined with a half turn.
TEST(SweepTest, AMoebiusStripIsRefused) {
  constexpr int kSteps = 12;
  std::vector<double> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kSteps;
    for (const double side : {-0.2, 0.2}) {
      const double reach = 1.0 + side * std::cos(0.5 * turn);
      points.insert(points.end(),
                    {reach * std::cos(turn), reach * std::sin(turn), side * std::sin(0.5 * turn)});
    }
    const bool last = i + 1 == kSteps;
    const std::int32_t a = 2 * i;
    const std::int32_t c = last ? 1 : a + 2;
    const std::int32_t d = last ? 0 : a + 3;
    triangles.push_back({a, a + 1, c});
    triangles.push_back({a + 1, d, c});
  }
  EXPECT_THROW(triangle_sweep(points, triangles), ParameterError);
}

}  // namespace
}  // namespace tissu
