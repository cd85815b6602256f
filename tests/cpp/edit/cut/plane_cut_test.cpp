/// Flat blades: the table of patterns in one tetrahedron, and bars of every cell type cut through.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "cut_body.h"

namespace tissu {
namespace {

const Mesh kTetra{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};

/// Two tetrahedra with the common face 1 2 3.
const Mesh kPair{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1},
                 {{CellType::tetra, {0, 1, 2, 3, 4, 2, 1, 3}}}};

std::size_t tetrahedra(const test::CutBody& body) {
  std::size_t count = 0;
  for (const auto& [cell, list] : body.material.cells) count += list.size();
  return count;
}

struct Row {
  Vec3 point;
  Vec3 normal;
  std::size_t tetrahedra;
  std::int32_t opened;
};

TEST(PlaneCutTest, OneTetrahedronIsCutAsTheTableSays) {
  const std::array<Row, 4> rows{{
      {{0, 0, 0.4}, {0, 0, 1}, 4, 1},      // a corner off
      {{0.4, 0, 0}, {1, 1, 0}, 6, 2},      // two against two
      {{0, 0, 0}, {0.4, -0.6, 0}, 2, 1},   // through an edge
      {{0, 0, 0}, {1, -0.5, -0.7}, 3, 1},  // through a node
  }};
  for (const Row& row : rows) {
    test::CutBody body(kTetra);
    const CutPlan plan = body.cut(body.plane(row.point, row.normal), {0.0, false});
    EXPECT_EQ(body.fault(), "");
    EXPECT_EQ(tetrahedra(body), row.tetrahedra);
    EXPECT_EQ(plan.faces_opened, row.opened);
    EXPECT_EQ(plan.born.size(), 2U);
    EXPECT_EQ(plan.gone, std::vector<std::int32_t>{0});
    EXPECT_EQ(body.piece_count(), 2U);
    EXPECT_EQ(body.characteristic(), 2);
  }
}

TEST(PlaneCutTest, ABladeInAFaceOpensTheFaceAndDividesNothing) {
  test::CutBody body(kPair);
  const CutPlan plan = body.cut(body.plane(Vec3(1, 0, 0), Vec3(1, 1, 1)), {0.0, false});
  EXPECT_EQ(body.fault(), "");
  EXPECT_EQ(plan.faces_opened, 1);
  EXPECT_EQ(tetrahedra(body), 2U);
  EXPECT_TRUE(plan.gone.empty());
  EXPECT_TRUE(plan.born.empty());
  ASSERT_EQ(plan.changed.size(), 1U);  // the cell of the lower number keeps the nodes
  EXPECT_EQ(plan.changed[0].number, 1);
  EXPECT_EQ(plan.changed[0].nodes, (std::vector<std::int32_t>{4, 6, 5, 7}));
  ASSERT_EQ(plan.nodes.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(plan.nodes[i].copied, static_cast<std::int32_t>(i + 1));
    EXPECT_TRUE(plan.nodes[i].material);
  }
  EXPECT_NEAR(plan.area, std::sqrt(3.0) / 2.0, 1e-15);
}

/// The area that is opened is that of the triangle in the plane z = 0.4, now and at rest.
TEST(PlaneCutTest, AreasAndSharesAreThoseOfTheSection) {
  test::CutBody body(kTetra);
  body.move([](const Vec3& X) -> Vec3 { return {2.0 * X[0], X[1], X[2]}; });
  const CutPlan plan = body.cut(body.plane(Vec3(0, 0, 0.4), Vec3(0, 0, 1)), {0.0, false});
  EXPECT_NEAR(plan.rest_area, 0.5 * 0.6 * 0.6, 1e-15);
  EXPECT_NEAR(plan.area, 0.6 * 0.6, 1e-15);
  ASSERT_EQ(plan.born.size(), 2U);
  const double top = 0.6 * 0.6 * 0.6;
  EXPECT_NEAR(std::min(plan.born[0].share, plan.born[1].share), top, 1e-15);
  EXPECT_NEAR(plan.born[0].share + plan.born[1].share, 1.0, 1e-15);
  EXPECT_NEAR(body.cut_area(), 2.0 * plan.rest_area, 1e-15);
}

/// Each replica has its own four nodes; copies without material are virtual, and no old node is.
TEST(PlaneCutTest, NodesWithoutMaterialAreVirtual) {
  test::CutBody body(kTetra);
  const CutPlan plan = body.cut(body.plane(Vec3(0, 0, 0.4), Vec3(0, 0, 1)), {0.0, false});
  ASSERT_EQ(plan.nodes.size(), 4U);
  for (const BornNode& node : plan.nodes) EXPECT_FALSE(node.material);
  EXPECT_TRUE(plan.emptied.empty());
  EXPECT_EQ(plan.first_node, 4);
}

class BarTest : public testing::TestWithParam<CellType> {};

/// One piece before and two after, for any plane through the middle, mesh and t0.
TEST_P(BarTest, CutThroughGivesTwoPieces) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const double t0 : {0.0, 0.02, 0.2}) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      test::CutBody body(test::typed_box(GetParam(), Vec3(3, 1, 1), {3, 2, 2}, 0.2, seed));
      const Vec3 direction(normal(random), normal(random), normal(random));
      const Vec3 point = Vec3(1.5, 0.5, 0.5) + 0.1 * Vec3(normal(random), normal(random), normal(random));
      const CutPlan plan = body.cut(body.plane(point, direction), {t0, false});
      const std::string which = "t0 " + std::to_string(t0) + ", seed " + std::to_string(seed);
      EXPECT_EQ(body.fault(), "") << which;
      EXPECT_EQ(body.piece_count(), 2U) << which;
      EXPECT_EQ(body.characteristic(), 2) << which;
      EXPECT_TRUE(plan.unresolved.empty()) << which;
      EXPECT_NEAR(body.cut_area(), 2.0 * plan.rest_area, 1e-12) << which;
    }
  }
}

/// Planes through nodes, along edges and faces of the grid; the section of the bar is the area that opens.
TEST_P(BarTest, PlanesOfTheGridOpenTheirSection) {
  struct Plane {
    Vec3 point;
    Vec3 normal;
    double area;
  };
  for (const Plane& plane :
       {Plane{{1, 0, 0}, {1, 0, 0}, 1.0}, Plane{{0, 0.5, 0}, {0, 1, 0}, 3.0},
        Plane{{0, 0, 0.5}, {0, 0, 1}, 3.0}, Plane{{1, 0, 0}, {1, -1, 0}, std::sqrt(2.0)}}) {
    test::CutBody body(test::typed_box(GetParam(), Vec3(3, 1, 1), {6, 2, 2}, 0.0, 1));
    const CutPlan plan = body.cut(body.plane(plane.point, plane.normal));
    EXPECT_EQ(body.fault(), "");
    EXPECT_EQ(body.piece_count(), 2U);
    EXPECT_NEAR(plan.rest_area, plane.area, 1e-12);
  }
}

/// A blade along faces of the grid divides no hexahedron: no cell is born.
TEST(PlaneCutTest, HexahedraApartAtTheirFacesStayWhole) {
  test::CutBody body(test::typed_box(CellType::hexahedron, Vec3(3, 1, 1), {3, 2, 2}, 0.0, 1));
  const CutPlan plan = body.cut(body.plane(Vec3(1, 0, 0), Vec3(1, 0, 0)));
  EXPECT_TRUE(plan.born.empty());
  EXPECT_TRUE(plan.gone.empty());
  EXPECT_EQ(plan.nodes.size(), 9U);
  EXPECT_EQ(plan.cells_cut, 8);
  EXPECT_EQ(plan.changed.size(), 4U);
}

INSTANTIATE_TEST_SUITE_P(EveryType, BarTest,
                         testing::Values(CellType::tetra, CellType::hexahedron, CellType::wedge,
                                         CellType::pyramid, CellType::tetra10, CellType::hexahedron20,
                                         CellType::hexahedron27, CellType::wedge15, CellType::pyramid13));

}  // namespace
}  // namespace tissu
