#include "tissu/mesh/box.h"

#include <gtest/gtest.h>

#include <numeric>

#include "sample_meshes.h"
#include "tissu/base/error.h"
#include "tissu/mesh/quality.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

class BoxTest : public testing::TestWithParam<Split> {};

TEST_P(BoxTest, VolumesArePositiveAndAddUp) {
  const std::vector<double> volume = volumes(test::sample_box(GetParam()));
  for (const double v : volume) EXPECT_GT(v, 0.0);
  EXPECT_NEAR(std::accumulate(volume.begin(), volume.end(), 0.0), 6.0, 1e-13);
}

TEST_P(BoxTest, NeighboursShareTheirFaces) {
  const Mesh mesh = test::sample_box(GetParam());
  const Surface surface = boundary_surface(mesh);
  // 2 (3*2 + 2*2 + 3*2) grid faces outside; a face that does not match its neighbour would add two more.
  EXPECT_EQ(surface.quads.size(), GetParam() == Split::none ? 32U : 0U);
  EXPECT_EQ(surface.triangles.size(), GetParam() == Split::none ? 0U : 64U);
  EXPECT_EQ(overfull_face_count(mesh), 0);
}

TEST_P(BoxTest, NodesRunXFastest) {
  const Mesh mesh = test::sample_box(GetParam());
  ASSERT_EQ(mesh.node_count(), 4 * 3 * 3);
  EXPECT_TRUE(mesh.node(0).isApprox(Vec3(-1.0, 0.5, 2.0)));
  EXPECT_TRUE(mesh.node(1).isApprox(Vec3(0.0, 0.5, 2.0)));
  EXPECT_TRUE(mesh.node(4).isApprox(Vec3(-1.0, 1.5, 2.0)));
  EXPECT_TRUE(mesh.node(12).isApprox(Vec3(-1.0, 0.5, 2.5)));
  EXPECT_TRUE(mesh.node(35).isApprox(Vec3(2.0, 2.5, 3.0)));
}

INSTANTIATE_TEST_SUITE_P(EverySplit, BoxTest, testing::ValuesIn(test::kSplits));

TEST(Box, CountsCells) {
  EXPECT_EQ(test::sample_box(Split::none).cell_count(), 12);
  EXPECT_EQ(test::sample_box(Split::six).cell_count(), 72);
  EXPECT_EQ(test::sample_box(Split::five).cell_count(), 60);
  EXPECT_EQ(test::sample_box(Split::six_mirrored).cell_count(), 72);
}

TEST(Box, SixTetrahedraShareTheDiagonal) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1}, Split::six);
  for (std::int32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(mesh.blocks[0].cell(i)[0], 0);
    EXPECT_EQ(mesh.blocks[0].cell(i)[3], 7);  // corner 6 of the hexahedron is the last node of the grid
  }
}

TEST(Box, RefusesEmptyBoxes) {
  EXPECT_THROW(box_mesh(Vec3::Zero(), Vec3(1, 0, 1), {1, 1, 1}, Split::six), ParameterError);
  EXPECT_THROW(box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 0, 1}, Split::six), ParameterError);
  EXPECT_THROW(box_mesh(Vec3::Zero(), Vec3::Ones(), {2000, 2000, 2000}, Split::none), ParameterError);
}

}  // namespace
}  // namespace tissu
