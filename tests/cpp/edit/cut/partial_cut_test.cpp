/// Blades that end inside the body, that go on, that miss; cells taken out.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "cut_body.h"
#include "tissu/base/error.h"
#include "tissu/mesh/box.h"

namespace tissu {
namespace {

constexpr std::array kCells{8, 4, 4};
const Vec3 kSize(2, 1, 1);

test::CutBody bar(std::uint64_t seed = 3) {
  return test::CutBody(test::typed_box(CellType::tetra, kSize, kCells, 0.15, seed));
}

/// The strip x = 1, from above down to z, over the whole width: its edge along y at some moments.
std::vector<double> strip(double z, int moments) {
  std::vector<double> places;
  for (int k = 0; k < moments; ++k) {
    const double height = 1.2 + (z - 1.2) * k / (moments - 1);
    places.insert(places.end(), {1.013, -0.1, height, 1.013, 1.1, height});
  }
  return places;
}

TEST(PartialCutTest, ASlitOpensAndStaysOnePiece) {
  test::CutBody body = bar();
  const CutPlan plan = body.cut(edge_sweep(strip(0.4, 2), 2, 2));
  EXPECT_EQ(body.fault(), "");
  EXPECT_EQ(body.piece_count(), 1U);
  EXPECT_EQ(body.characteristic(), 1);
  EXPECT_GT(plan.born.size(), 0U);
  EXPECT_GT(plan.rest_area, 0.35);  // the front lags the blade by less than a cell, 0.25
  EXPECT_LT(plan.rest_area, 0.65);
}

TEST(PartialCutTest, ADiscInsideOpensNoWayOut) {
  test::CutBody body = bar();
  const CutPlan plan = body.cut(disc_sweep(Vec3(1.01, 0.52, 0.49), Vec3(1, 0.2, 0.1), 0.45));
  EXPECT_EQ(body.fault(), "");
  EXPECT_GT(plan.faces_opened, 0);
  EXPECT_EQ(body.characteristic(), 2);  // a cavity without volume: the body's border is two spheres
  EXPECT_EQ(body.piece_count(), 1U);
}

TEST(PartialCutTest, ABladeThatMissesPlansNothing) {
  test::CutBody body = bar();
  for (const Sweep& sweep :
       {disc_sweep(Vec3(1, 0.5, 3), Vec3(0, 0, 1), 0.5), Sweep{}, body.plane(Vec3(0, 0, 7), Vec3(0, 0, 1))}) {
    const CutPlan plan = body.cut(sweep);
    EXPECT_TRUE(plan.empty());
    EXPECT_TRUE(plan.unresolved.empty());
    EXPECT_TRUE(plan.nodes.empty());
    EXPECT_TRUE(plan.material.cells.empty());
    EXPECT_TRUE(body.material.cells.empty());
  }
}

TEST(PartialCutTest, ARingCutOnceIsABar) {
  Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 3, 1), {3, 3, 1}, Split::six);
  std::vector<std::int32_t>& nodes = mesh.blocks[0].nodes;
  nodes.erase(nodes.begin() + std::ptrdiff_t{4 * 6 * 4}, nodes.begin() + std::ptrdiff_t{4 * 6 * 5});
  test::CutBody body(mesh);
  EXPECT_EQ(body.characteristic(), 0);
  const std::array<double, 12> once{1.45, -1, -1, 1.45, 1.5, -1, 1.45, 1.5, 2, 1.45, -1, 2};
  const std::array<std::array<std::int32_t, 3>, 2> square{{{0, 1, 2}, {0, 2, 3}}};
  body.cut(triangle_sweep(once, square));
  EXPECT_EQ(body.fault(), "");
  EXPECT_EQ(body.characteristic(), 1);
  EXPECT_EQ(body.piece_count(), 1U);
  body.cut(body.plane(Vec3(1.55, 0, 0), Vec3(1, 0, 0)));
  EXPECT_EQ(body.fault(), "");
  EXPECT_EQ(body.piece_count(), 3U);  // both sides, and a slab between the two cuts of one arm
}

/// The same way of a blade in one sweep or in many. Each sweep goes on where the last one was, so that the
/// same cells part, but for those at the front.
TEST(PartialCutTest, AnIncisionGoesOnFromSweepToSweep) {
  test::CutBody whole = bar();
  whole.cut(edge_sweep(strip(0.15, 2), 2, 2));
  for (const int parts : {10, 100}) {
    test::CutBody body = bar();
    const std::vector<double> places = strip(0.15, parts + 1);
    double area = 0.0;
    for (int k = 1; k <= parts; ++k) {
      const int first = std::max(0, k - 2);
      const std::span<const double> way = std::span(places).subspan(
          static_cast<std::size_t>(6 * first), static_cast<std::size_t>(6 * (k - first + 1)));
      area += body.cut(edge_sweep(way, k - first + 1, 2, 5)).rest_area;
    }
    EXPECT_EQ(body.fault(), "") << parts;
    EXPECT_EQ(body.piece_count(), 1U) << parts;
    EXPECT_EQ(body.characteristic(), 1) << parts;
    EXPECT_NEAR(area, whole.cut_area() / 2.0, 0.25 * 0.25) << parts;  // a cell of difference
    ASSERT_EQ(body.material.incisions.size(), 1U);
    EXPECT_EQ(body.material.incisions[0].number, 5);
  }
}

/// A blade that runs along faces divides nothing, and meets the vertices of a face one after the other.
TEST(PartialCutTest, AnIncisionAlongFacesGoesOnFromSweepToSweep) {
  for (const Split split : {Split::six, Split::none}) {
    for (const int parts : {1, 7, 50}) {
      test::CutBody body(box_mesh(Vec3::Zero(), kSize, kCells, split));
      std::vector<double> places;
      for (int k = 0; k <= parts; ++k) {
        const double z = 1.2 - 0.75 * k / parts;
        places.insert(places.end(), {1.0, -0.1, z, 1.0, 1.1, z});
      }
      double area = 0.0;
      for (int k = 1; k <= parts; ++k) {
        const int first = std::max(0, k - 2);
        const std::span<const double> way = std::span(places).subspan(
            static_cast<std::size_t>(6 * first), static_cast<std::size_t>(6 * (k - first + 1)));
        area += body.cut(edge_sweep(way, k - first + 1, 2, 5)).rest_area;
      }
      EXPECT_EQ(body.fault(), "") << parts;
      EXPECT_NEAR(area, 0.5, 1e-12) << parts;  // down to the nodes at z = 0.5
    }
  }
}

/// A bent blade through the bar, in one sweep and in steps that go on: two pieces, and dust where the blade
/// bends across an edge twice (flat parts below a hundredth of the mean cell).
TEST(PartialCutTest, ABentBladeThroughGivesTwoPieces) {
  for (const CellType type : {CellType::tetra, CellType::hexahedron}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      std::vector<double> places;
      for (int k = 0; k <= 20; ++k) {
        const double z = 1.2 - 0.07 * k;
        for (int i = 0; i < 5; ++i) {
          const double y = -0.1 + 0.3 * i;
          places.insert(places.end(), {1.01 + 0.25 * std::sin(2.5 * z) + 0.02 * std::sin(3.0 * y), y, z});
        }
      }
      test::CutBody whole(test::typed_box(type, kSize, kCells, 0.15, seed));
      whole.cut(edge_sweep(places, 21, 5));
      test::CutBody steps(test::typed_box(type, kSize, kCells, 0.15, seed));
      for (int k = 1; k <= 20; ++k) {
        const int first = std::max(0, k - 2);
        const std::span<const double> way = std::span(places).subspan(
            static_cast<std::size_t>(15 * first), static_cast<std::size_t>(15 * (k - first + 1)));
        steps.cut(edge_sweep(way, k - first + 1, 5, 1));
      }
      for (const test::CutBody* body : {&whole, &steps}) {
        EXPECT_EQ(body->fault(), "") << seed;
        const std::vector<Piece> all = pieces(body->hosts, body->material);
        const double mean_cell = 2.0 / static_cast<double>(body->hosts.numbers().size());
        const auto large =
            std::ranges::count_if(all, [&](const Piece& piece) { return piece.volume > 1e-2 * mean_cell; });
        EXPECT_EQ(large, 2) << seed;
        EXPECT_LE(all.size(), 3U) << seed;
      }
      EXPECT_NEAR(whole.cut_area(), steps.cut_area(), 0.05 * whole.cut_area()) << seed;
    }
  }
}

/// A disc through the bottom of a tetrahedron crosses no edge. The longest edge is 1 2; from its middle to
/// node 0 runs an edge that the disc crosses.
TEST(PartialCutTest, AStabIsUnresolvedUnlessItRefines) {
  const Mesh mesh{{0, 0, 0, 1.1, 0, 0, 0, 1.1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};
  const Sweep stab = disc_sweep(Vec3(0.25, 0.25, 0.05), Vec3(1, 1, 0), 0.15);
  test::CutBody body(mesh);
  const CutPlan plan = body.cut(stab);
  EXPECT_TRUE(plan.empty());
  ASSERT_EQ(plan.unresolved.size(), 1U);
  EXPECT_EQ(plan.unresolved[0].second, Unresolved::pierced);
  EXPECT_FALSE(words(plan.unresolved[0].second).empty());
  EXPECT_TRUE(body.material.cells.empty());
  test::CutBody refined(mesh);
  const CutPlan second = refined.cut(stab, {0.02, true});
  EXPECT_EQ(second.cells_cut, 1);
  // It crosses edges then, and parts nothing all the same.
  ASSERT_FALSE(second.unresolved.empty());
  for (const auto& [cell, reason] : second.unresolved) EXPECT_EQ(reason, Unresolved::ends) << cell;
  EXPECT_EQ(refined.fault(), "");
}

/// Two parts of one sweep that cross, as two cuts one after the other.
TEST(PartialCutTest, CrossingPartsGiveFourPieces) {
  test::CutBody body = bar();
  Sweep cross = body.plane(Vec3(1.01, 0, 0), Vec3(1, 0.1, 0));
  cross.parts.push_back(body.plane(Vec3(0, 0.49, 0), Vec3(0, 1, 0.2)).parts[0]);
  body.cut(cross);
  EXPECT_EQ(body.fault(), "");
  EXPECT_EQ(body.piece_count(), 4U);
  test::CutBody other = bar();
  other.cut(body.plane(Vec3(1.01, 0, 0), Vec3(1, 0.1, 0)));
  other.cut(body.plane(Vec3(0, 0.49, 0), Vec3(0, 1, 0.2)));
  EXPECT_EQ(other.piece_count(), 4U);
  EXPECT_NEAR(body.cut_area(), other.cut_area(), 1e-12);
}

TEST(PartialCutTest, CutsOfCutsDownToDustKeepTheVolume) {
  test::CutBody body(test::typed_box(CellType::hexahedron, Vec3::Ones(), {2, 2, 2}, 0.1, 4));
  std::mt19937_64 random(11);
  for (int i = 0; i < 30; ++i) {
    body.cut(test::random_sweep(random, body), {i % 2 == 0 ? 0.0 : 0.02, false});
    ASSERT_EQ(body.fault(), "") << i;
  }
  EXPECT_GT(body.piece_count(), 30U);
}

/// A copy without material at it carries a part: the plan of the next cut still knows.
TEST(PartialCutTest, ShareBelowTheLeastGoesToTheNode) {
  test::CutBody body(Mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}});
  const CutPlan plan = body.cut(body.plane(Vec3(0, 0, 1.0 - 1e-5), Vec3(0, 0, 1)), {0.0, false});
  EXPECT_EQ(body.fault(), "");
  EXPECT_TRUE(plan.born.empty());  // a tip of 1e-15 of the cell stays
  const CutPlan other = body.cut(body.plane(Vec3(0, 0, 0.99), Vec3(0, 0, 1)), {0.0, false});
  EXPECT_EQ(other.born.size(), 2U);  // 1e-6 of it does not
}

TEST(PartialCutTest, AblationPartsWhatHangsByAnEdge) {
  test::CutBody body(box_mesh(Vec3::Zero(), Vec3(2, 2, 1), {2, 2, 1}, Split::none));
  const CutPlan plan = body.ablate({0, 3});
  EXPECT_EQ(plan.gone, (std::vector<std::int32_t>{0, 3}));
  ASSERT_EQ(plan.nodes.size(), 2U);  // the edge in the middle, of cells 1 and 2
  EXPECT_EQ(plan.nodes[0].copied, 4);
  EXPECT_EQ(plan.nodes[1].copied, 13);
  ASSERT_EQ(plan.changed.size(), 1U);
  EXPECT_EQ(plan.changed[0].number, 2);
  EXPECT_EQ(plan.emptied, (std::vector<std::int32_t>{0, 8, 9, 17}));
  EXPECT_EQ(body.fault(), "");
  EXPECT_EQ(body.piece_count(), 2U);
}

TEST(PartialCutTest, CellsOfACutBodyAreTakenOut) {
  test::CutBody body = bar();
  body.cut(body.plane(Vec3(1.01, 0, 0), Vec3(1, 0.1, 0)));
  const CutPlan cut = body.cut(body.plane(Vec3(0.3, 0, 0), Vec3(1, 0.1, 0.4)));
  const double before = body.volume();
  double gone = 0.0;
  const std::vector<std::int32_t> taken{cut.born[0].number, cut.born[3].number};
  const std::vector<Piece> pieces_before = pieces(body.hosts, body.material);
  for (const std::int32_t cell : taken) {
    for (const MaterialTetra& tetra : body.material.cells.at(cell)) {
      std::array<Vec3, 4> p;
      for (std::size_t i = 0; i < 4; ++i) p[i] = body.material.at(tetra.vertices[i], body.hosts.rest());
      gone += (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
    }
  }
  body.hosts.remove(taken);
  body.material.remove(taken);
  EXPECT_NEAR(body.volume(), before - gone, 1e-13);
  for (const std::int32_t cell : taken) EXPECT_FALSE(body.hosts.has(cell));
  EXPECT_THROW(body.hosts.remove(taken), ParameterError);
  const CutPlan next = body.cut(body.plane(Vec3(0.3, 0.5, 0.5), Vec3(0.1, 0.1, 1)));
  EXPECT_FALSE(next.empty());
  EXPECT_EQ(next.born[0].number, cut.born.back().number + 1);  // no number is used twice
}

/// A cut does not depend on the order of the blade's triangles.
TEST(PartialCutTest, TheOrderOfTrianglesDoesNotMatter) {
  test::CutBody body = bar();
  Sweep sweep = disc_sweep(Vec3(1.01, 0.52, 0.49), Vec3(1, 0.2, 0.1), 0.45);
  const CutPlan plan = plan_cut(body.hosts, body.material, body.x, sweep);
  std::ranges::reverse(sweep.parts[0].triangles);
  std::ranges::reverse(sweep.parts[0].border);
  const CutPlan other = plan_cut(body.hosts, body.material, body.x, sweep);
  EXPECT_EQ(plan.gone, other.gone);
  EXPECT_EQ(plan.faces_opened, other.faces_opened);
  ASSERT_EQ(plan.born.size(), other.born.size());
  for (std::size_t i = 0; i < plan.born.size(); ++i) {
    EXPECT_EQ(plan.born[i].nodes, other.born[i].nodes);
    EXPECT_NEAR(plan.born[i].share, other.born[i].share, 1e-12);
  }
}

/// A moving body and a still blade cut the same line as a still body and a moving blade.
TEST(PartialCutTest, OnlyTheRelativeMotionCounts) {
  test::CutBody still = bar();
  test::CutBody moved = bar();
  const Mat3 turn = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  moved.move([&](const Vec3& X) -> Vec3 { return turn * X + Vec3(4, 0, 0); });
  const CutPlan plan = still.cut(disc_sweep(Vec3(1.01, 0.52, 0.49), Vec3(1, 0.2, 0.1), 0.45));
  const CutPlan other =
      moved.cut(disc_sweep(turn * Vec3(1.01, 0.52, 0.49) + Vec3(4, 0, 0), turn * Vec3(1, 0.2, 0.1), 0.45));
  EXPECT_EQ(plan.gone, other.gone);
  EXPECT_NEAR(plan.rest_area, other.rest_area, 0.02);  // the rims are polygons that are turned otherwise
}

}  // namespace
}  // namespace tissu
