#include "tissu/mesh/quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_meshes.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

class CellTypeTest : public testing::TestWithParam<CellType> {};

TEST(Quality, RegularTetrahedronIsIdeal) {
  const Mesh mesh{{1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};
  EXPECT_NEAR(volumes(mesh)[0], 8.0 / 3.0, 1e-14);
  EXPECT_NEAR(shape_qualities(mesh)[0], 1.0, 1e-14);
}

TEST(Quality, CornerTetrahedron) {
  // V = 1/6, l_rms^2 = (3 * 1 + 3 * 2) / 6 = 3/2.
  EXPECT_NEAR(shape_qualities(test::unit_tetra())[0], std::sqrt(2.0) / std::pow(1.5, 1.5), 1e-14);
  EXPECT_NEAR(jacobian_ranges(test::unit_tetra())[0].smallest, 1.0, 1e-14);
}

TEST(Quality, CubeIsIdeal) {
  const Mesh mesh = test::unit_hexahedron();
  EXPECT_NEAR(volumes(mesh)[0], 1.0, 1e-14);
  EXPECT_NEAR(shape_qualities(mesh)[0], 1.0, 1e-14);
  EXPECT_NEAR(jacobian_ranges(mesh)[0].smallest, 0.125, 1e-14);
  EXPECT_NEAR(jacobian_ranges(mesh)[0].largest, 0.125, 1e-14);
}

TEST(Quality, FrustumVolumeIsExact) {
  Mesh mesh = test::unit_hexahedron();
  for (std::size_t node = 4; node < 8; ++node)  // top square of half the edge
    for (std::size_t axis = 0; axis < 2; ++axis) mesh.positions[3 * node + axis] *= 0.5;
  EXPECT_NEAR(volumes(mesh)[0], (1.0 + 0.5 + 0.25) / 3.0, 1e-14);
  EXPECT_LT(shape_qualities(mesh)[0], 1.0);
}

TEST(Quality, DegenerateCellsAreZero) {
  const Mesh point{std::vector<double>(24, 1.0),
                   {{CellType::tetra, {0, 1, 2, 3}}, {CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}}}};
  EXPECT_EQ(volumes(point), (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(shape_qualities(point), (std::vector<double>{0.0, 0.0}));
}

TEST_P(CellTypeTest, ReferenceCellHasItsVolumeAndIsWellShaped) {
  const Mesh mesh = test::one_cell(GetParam());
  EXPECT_NEAR(volumes(mesh)[0], test::reference_volume(GetParam()), 1e-13);
  EXPECT_NEAR(jacobian_ranges(mesh)[0].smallest, 1.0, 1e-13);
  EXPECT_NEAR(jacobian_ranges(mesh)[0].largest, 1.0, 1e-13);
  EXPECT_GT(shape_qualities(mesh)[0], 0.7);
  EXPECT_LE(shape_qualities(mesh)[0], 1.0);
}

TEST_P(CellTypeTest, MirroringTwiceIsNothingAndOnceTurnsIt) {
  Mesh mesh = test::one_cell(GetParam());
  const std::span<const std::uint8_t> mirror = mirrored(GetParam());
  for (std::size_t n = 0; n < mirror.size(); ++n) EXPECT_EQ(mirror[mirror[n]], n);
  for (std::size_t n = 2; n < mesh.positions.size(); n += 3) mesh.positions[n] *= -1.0;
  const double volume = volumes(mesh)[0];
  EXPECT_LT(volume, 0.0);
  EXPECT_LT(shape_qualities(mesh)[0], 0.0);
  EXPECT_EQ(turn_reversed_cells(mesh), 1);
  EXPECT_NEAR(volumes(mesh)[0], -volume, 1e-14);
  EXPECT_NEAR(jacobian_ranges(mesh)[0].smallest, 1.0, 1e-13);  // middles stand between their corners
  EXPECT_EQ(turn_reversed_cells(mesh), 0);
}

INSTANTIATE_TEST_SUITE_P(EveryType, CellTypeTest, testing::ValuesIn(test::kTypes), test::type_name);

TEST(Quality, IdealWedgesAndPyramids) {
  const double h = std::sqrt(3.0) / 2.0;
  const Mesh wedge{{0, 0, 0, 1, 0, 0, 0.5, h, 0, 0, 0, 1, 1, 0, 1, 0.5, h, 1},
                   {{CellType::wedge, {0, 1, 2, 3, 4, 5}}}};
  EXPECT_NEAR(shape_qualities(wedge)[0], 1.0, 1e-14);
  const Mesh pyramid{{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, std::sqrt(0.5)},
                     {{CellType::pyramid, {0, 1, 2, 3, 4}}}};
  EXPECT_NEAR(shape_qualities(pyramid)[0], 1.0, 1e-14);
}

TEST(Quality, ReversedCellsAreTurned) {
  Mesh mesh{{},
            {{CellType::hexahedron, {4, 5, 6, 7, 0, 1, 2, 3}}, {CellType::tetra, {0, 2, 1, 4, 0, 1, 2, 4}}}};
  mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  EXPECT_LT(shape_qualities(mesh)[0], 0.0);
  EXPECT_EQ(turn_reversed_cells(mesh), 2);
  for (const double v : volumes(mesh)) EXPECT_GT(v, 0.0);
  EXPECT_EQ(mesh.blocks[0].nodes, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(turn_reversed_cells(mesh), 0);
}

TEST(Quality, NoTurningMendsATangledHexahedron) {
  Mesh mesh = test::unit_hexahedron();
  std::swap(mesh.blocks[0].nodes[4], mesh.blocks[0].nodes[6]);
  const JacobianRange range = jacobian_ranges(mesh)[0];
  EXPECT_LT(range.smallest, 0.0);
  EXPECT_GT(range.largest, 0.0);
  EXPECT_EQ(turn_reversed_cells(mesh), 0);
}

TEST(Quality, SplitsAreWellShaped) {
  for (const Split split : test::kSplits)
    for (const double quality : shape_qualities(box_mesh(Vec3::Zero(), Vec3(2, 2, 2), {2, 2, 2}, split)))
      EXPECT_GT(quality, 0.6);
}

TEST(CellTypes, AreFoundByName) {
  for (const CellTypeInfo& row : cell_types()) {
    EXPECT_EQ(cell_type(row.name), row.type);
    EXPECT_EQ(&info(row.type), &row);
  }
  EXPECT_FALSE(cell_type("wedge18").has_value());
}

}  // namespace
}  // namespace tissu
