#include <gtest/gtest.h>

#include "sample_frames.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

using test::kSpacing;
using test::RowView;

const ShapeFunctionUse kTrilinear{.name = "trilinear"};

TEST(Trilinear, HasACellsCornersForNeighbours) {
  const auto frames = test::frame_lattice({4, 3, 3}, 0.0);
  const std::vector<double> point{2.25 * kSpacing, 0.5 * kSpacing, 1.5 * kSpacing};
  const FrameWeights all = shape_weights(kTrilinear, frames, point);
  EXPECT_EQ(all.frames, (std::vector<std::int32_t>{14, 15, 18, 19, 26, 27, 30, 31}));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(all.weights[i], (i % 2 == 0 ? 0.75 : 0.25) / 4.0, 1e-15);
}

// Nothing asks for even spacing, for an order of the frames or for a place of the grid.
TEST(Trilinear, TakesAnyAxisAlignedGridInAnyOrder) {
  const std::vector<std::vector<double>> axes{{-1.0, -0.7, 0.1, 0.3}, {5.0, 5.5}, {0.0, 2.0, 2.125}};
  std::vector<Vec3> grid;
  for (const double x : axes[0]) {
    for (const double z : axes[2]) {
      for (const double y : axes[1]) grid.emplace_back(x, y, z);
    }
  }
  std::ranges::reverse(grid.begin() + 3, grid.begin() + 17);
  std::vector<double> frames;
  for (const Vec3& x : grid) frames.insert(frames.end(), x.begin(), x.end());
  const std::vector<double> points{-0.9, 5.1, 0.3, 0.2, 5.4, 2.1, 0.0, 5.25, 2.0};
  const FrameWeights all = shape_weights(kTrilinear, frames, points);
  for (std::size_t s = 0; s < 3; ++s) {
    const RowView row{all, s};
    const Vec3 x = block(ConstReals(points), static_cast<std::int32_t>(s));
    EXPECT_LT((row.position(frames) - x).norm(), 1e-14);
    EXPECT_LT((row.position_gradient(frames) - Mat3::Identity()).norm(), 1e-13);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_GE(row.weight(i), 0.0);
  }
}

TEST(Trilinear, HasFourNeighboursInAPlaneAndTwoOnALine) {
  for (const auto& [counts, neighbours] :
       {std::pair<std::array<int, 3>, int>{{4, 1, 3}, 4}, {{1, 3, 3}, 4}, {{1, 1, 5}, 2}, {{1, 4, 1}, 2}}) {
    const FrameWeights all =
        shape_weights(kTrilinear, test::frame_lattice(counts, 0.0), test::sample_points(3, counts));
    EXPECT_EQ(all.neighbours, neighbours);
  }
}

TEST(Trilinear, GoesOnForHalfACell) {
  const auto frames = test::frame_lattice({3, 3, 3}, 0.0);
  const std::vector<double> point{-0.5 * kSpacing, 2.5 * kSpacing, 2.4 * kSpacing};
  const FrameWeights all = shape_weights(kTrilinear, frames, point);
  EXPECT_LT(((RowView{all, 0}.position(frames)) - Vec3(point.data())).norm(), 1e-15);
  EXPECT_LT((RowView{all, 0}.position_gradient(frames) - Mat3::Identity()).norm(), 1e-13);
  const std::vector<double> farther{-0.51 * kSpacing, 0.0, 0.0};
  EXPECT_THROW(shape_weights(kTrilinear, frames, farther), MeshError);
}

// The neighbours of the two cells differ, what they share has the same weights.
TEST(Trilinear, IsContinuousBetweenCells) {
  const auto frames = test::frame_lattice({3, 3, 3}, 0.0);
  const double h = 1e-12;
  const std::vector<double> points{kSpacing - h, 0.3 * kSpacing, 0.6 * kSpacing,
                                   kSpacing + h, 0.3 * kSpacing, 0.6 * kSpacing};
  const FrameWeights all = shape_weights(kTrilinear, frames, points);
  for (std::int32_t i = 0; i < 27; ++i) {
    EXPECT_NEAR((RowView{all, 0}.weight_of(i)), (RowView{all, 1}.weight_of(i)), 4.0 * h / kSpacing);
  }
}

}  // namespace
}  // namespace tissu
