/// Blades with walls that are nearer to one another than a cell, and with sharp corners.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "cut_body.h"

namespace tissu {
namespace {

constexpr std::array kCells{8, 6, 3};
constexpr double kEdge = 0.25;
const Vec3 kSize(2, 1.5, 0.75);

using Point = std::array<double, 2>;

/// The surface over a line of points in the x y plane, from below the body to above it.
Sweep walls(const std::vector<Point>& line, bool closed) {
  std::vector<double> points;
  for (const auto& [x, y] : line) points.insert(points.end(), {x, y, -0.2, x, y, 1.0});
  std::vector<std::array<std::int32_t, 3>> triangles;
  const auto count = static_cast<std::int32_t>(line.size());
  for (std::int32_t i = 0; i + 1 < count + (closed ? 1 : 0); ++i) {
    const std::int32_t a = 2 * i;
    const std::int32_t b = 2 * ((i + 1) % count);
    triangles.push_back({a, b, b + 1});
    triangles.push_back({a, b + 1, a + 1});
  }
  return triangle_sweep(points, triangles);
}

/// Up to the wall y = 1.5 of the body and out of it.
Sweep u_shape(double width, double tilt) {
  const double x = 1.013;
  return walls({{x - width / 2, 2.0},
                {x - width / 2 + tilt, 0.61},
                {x + width / 2 + tilt, 0.61},
                {x + width / 2, 2.0}},
               false);
}

Sweep wedge(double angle, double x) {
  const double reach = 1.5 * std::tan(0.5 * angle);
  return walls({{x - reach, 2.03}, {x, 0.53}, {x + reach, 2.03}}, false);
}

Sweep prism(double radius, int sides) {
  std::vector<Point> line;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides + 0.3;
    line.push_back({1.02 + radius * std::cos(angle), 0.77 + radius * std::sin(angle)});
  }
  return walls(line, true);
}

test::CutBody bar(CellType type) {
  return test::CutBody(test::typed_box(type, kSize, kCells, type == CellType::tetra ? 0.1 : 0.0, 5));
}

/// Parts that are larger than a tenth of a cell, and so not crumbs.
int large_pieces(const test::CutBody& body) {
  int count = 0;
  for (const Piece& piece : pieces(body.hosts, body.material)) {
    count += piece.volume > 0.1 * kEdge * kEdge * kEdge ? 1 : 0;
  }
  return count;
}

class WallsTest : public testing::TestWithParam<CellType> {
 protected:
  static void expect_parted(const Sweep& sweep, const std::string& what) {
    test::CutBody body = bar(GetParam());
    body.cut(sweep);
    EXPECT_EQ(body.fault(), "") << what;
    EXPECT_GE(large_pieces(body), 2) << what;
  }
};

TEST_P(WallsTest, AUNarrowerThanACellCutsItsInsideOut) {
  for (const double width : {0.3, 0.6, 1.0, 1.5}) {
    for (const double tilt : {0.0, 0.04}) {
      expect_parted(u_shape(width * kEdge, tilt), std::to_string(width) + " cells, " + std::to_string(tilt));
    }
  }
}

TEST_P(WallsTest, AWedgeIsCutOut) {
  for (const double angle : {0.5, 1.0, 1.6, 2.1}) {
    for (const double x : {1.013, 1.1}) expect_parted(wedge(angle, x), std::to_string(angle));
  }
}

TEST_P(WallsTest, AThinPrismIsCutOut) {
  for (const double radius : {0.5, 0.8, 1.4}) {
    for (const int sides : {4, 12}) expect_parted(prism(radius * kEdge, sides), std::to_string(radius));
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, WallsTest, testing::Values(CellType::tetra, CellType::hexahedron),
                         [](const auto& type) { return std::string(tissu::info(type.param).name); });

/// Where cells are divided a crossing goes to an end of an edge within a fifth of it. Walls that are as near
/// to each other as that may meet.
TEST(WallsOfDividedCellsTest, TheInsideComesOutOrThePlanNamesTheCells) {
  test::CutBody wide = bar(CellType::tetra);
  wide.cut(u_shape(0.6 * kEdge, 0.0), {.divide = true});
  EXPECT_EQ(large_pieces(wide), 2);
  test::CutBody narrow = bar(CellType::tetra);
  const CutPlan plan = narrow.cut(u_shape(0.1 * kEdge, 0.0), {.divide = true});
  EXPECT_GT(plan.bridges(), 0);
  EXPECT_LE(plan.bridges(), static_cast<std::int32_t>(plan.unresolved.size()));
}

/// A flat blade, a round one and the border of a blade are none.
TEST(WallsOfDividedCellsTest, OtherBladesHaveNoBridges) {
  for (const CellType type : {CellType::tetra, CellType::hexahedron}) {
    for (const Sweep& sweep : {disc_sweep(Vec3(1.01, 0.72, 0.4), Vec3(1, 0.2, 0.1), 0.45),
                               disc_sweep(Vec3(1.01, 0.72, 0.4), Vec3(1, 1, 1), 5.0), prism(0.6, 24)}) {
      test::CutBody body = bar(type);
      EXPECT_EQ(body.cut(sweep).bridges(), 0);
    }
  }
}

}  // namespace
}  // namespace tissu
