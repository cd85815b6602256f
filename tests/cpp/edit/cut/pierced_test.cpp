/// Blades that are narrower than the cells that they pierce.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "cut_body.h"

namespace tissu {
namespace {

constexpr std::array kCells{4, 4, 3};
const Vec3 kSize(1.0, 1.0, 0.75);

test::CutBody boxes() { return test::CutBody(test::typed_box(CellType::hexahedron, kSize, kCells, 0.0, 1)); }

/// A cylinder from below the body to above it, between the edges of cells.
Sweep needle(const Vec3& from, const Vec3& to, double radius) {
  constexpr int kSides = 6;
  std::vector<double> points;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides + 0.1;
    const Vec3 out(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    for (const Vec3& end : {from, to}) {
      const Vec3 p = end + out;
      points.insert(points.end(), p.data(), p.data() + 3);
    }
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int32_t i = 0; i < kSides; ++i) {
    const std::int32_t a = 2 * i;
    const std::int32_t b = 2 * ((i + 1) % kSides);
    triangles.push_back({a, b, b + 1});
    triangles.push_back({a, b + 1, a + 1});
  }
  return triangle_sweep(points, triangles);
}

/// Cells of first-day boxes in which points of a segment lie.
std::set<std::int32_t> cells_along(const test::CutBody& body, const Vec3& from, const Vec3& to) {
  std::set<std::int32_t> cells;
  for (int i = 0; i <= 1000; ++i) {
    const Vec3 p = from + i / 1000.0 * (to - from);
    for (const std::int32_t cell : body.hosts.numbers()) {
      Eigen::AlignedBox3d box;
      for (const std::int32_t node : body.hosts.corners(cell))
        box.extend(Vec3(block(body.hosts.rest(), node)));
      if (box.contains(p)) cells.insert(cell);
    }
  }
  return cells;
}

/// Cells that a plan neither replaces nor names.
std::vector<std::int32_t> forgotten(const std::set<std::int32_t>& cells, const CutPlan& plan) {
  std::vector<std::int32_t> left;
  for (const std::int32_t cell : cells) {
    const bool named =
        std::ranges::any_of(plan.unresolved, [&](const auto& one) { return one.first == cell; });
    if (!named && !std::ranges::binary_search(plan.gone, cell)) left.push_back(cell);
  }
  return left;
}

TEST(PiercedTest, ACylinderNarrowerThanACellNamesTheCells) {
  const Vec3 from(0.56, 0.67, -0.1);
  const Vec3 to(0.66, 0.59, 0.9);
  for (const bool refine : {false, true}) {
    test::CutBody body = boxes();
    const std::set<std::int32_t> cells = cells_along(body, from, to);
    ASSERT_EQ(cells.size(), 3U);
    const CutPlan plan = body.cut(needle(from, to, 0.006), {.refine = refine});
    EXPECT_EQ(forgotten(cells, plan), std::vector<std::int32_t>{}) << refine;
    EXPECT_EQ(body.fault(), "");
  }
}

TEST(PiercedTest, ADiscInsideACellNamesIt) {
  const Vec3 center(0.57, 0.66, 0.31);
  for (const double radius : {0.001, 0.01}) {
    for (const bool refine : {false, true}) {
      test::CutBody body = boxes();
      const std::set<std::int32_t> cells = cells_along(body, center, center);
      ASSERT_EQ(cells.size(), 1U);
      const CutPlan plan = body.cut(disc_sweep(center, Vec3(0.3, 0.2, 1), radius), {.refine = refine});
      EXPECT_EQ(forgotten(cells, plan), std::vector<std::int32_t>{}) << radius << ' ' << refine;
    }
  }
}

/// The blade ends in the body; the cells before its border are not named.
TEST(PiercedTest, ADiscLargerThanCellsNamesNone) {
  test::CutBody body = boxes();
  EXPECT_TRUE(body.cut(disc_sweep(Vec3(0.51, 0.52, 0.31), Vec3(1, 0.2, 0.1), 0.36)).unresolved.empty());
}

}  // namespace
}  // namespace tissu
