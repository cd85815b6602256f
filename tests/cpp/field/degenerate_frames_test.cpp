#include <gtest/gtest.h>

#include "sample_frames.h"
#include "tissu/base/error.h"

/// Frames in a plane, on a line, alone, crowded: every function either has finite weights that are a
/// partition of unity or says which point is wrong. Never infinity.
namespace tissu {
namespace {

using test::kSpacing;
using test::RowView;

class DegenerateFrames : public testing::TestWithParam<ShapeFunctionInfo> {
 protected:
  const ShapeFunctionInfo& info_ = GetParam();

  /// A frame-fixed basis: axes for grids, any for the others.
  Mat3 turned() const {
    if (info_.needs_grid) return Mat3::Identity();
    return test::Random(5).rotation().toRotationMatrix();
  }
  static std::vector<double> turn(const Mat3& R, std::vector<double> positions) {
    for (std::size_t i = 0; i < positions.size() / 3; ++i) {
      const Vec3 x = R * block(Reals(positions), static_cast<std::int32_t>(i));
      block(Reals(positions), static_cast<std::int32_t>(i)) = x;
    }
    return positions;
  }
  FrameWeights weights(ConstReals frames, ConstReals points) const {
    return shape_weights(test::use_of(info_), frames, points, {.body = "liver"});
  }
  static void expect_partition(const FrameWeights& all) {
    const std::size_t count = all.weights.size() / static_cast<std::size_t>(all.neighbours);
    for (std::size_t s = 0; s < count; ++s) {
      EXPECT_NEAR((RowView{all, s}.sum()), 1.0, 1e-10) << s;
      EXPECT_LT((RowView{all, s}.gradient_sum().norm()) * kSpacing, 1e-8) << s;
      EXPECT_TRUE((RowView{all, s}.gradient_sum().allFinite())) << s;
    }
  }
  /// Frames and points that span the first `dimension` columns of turned().
  void expect_good_within(int dimension, std::array<int, 3> counts) const {
    const Mat3 R = turned();
    const auto frames = turn(R, test::sample_frames(info_, counts));
    const auto points = turn(R, test::sample_points(20, counts));
    const FrameWeights all = weights(frames, points);
    expect_partition(all);
    Mat3 within = Mat3::Zero();
    for (int a = 0; a < dimension; ++a) within += R.col(a) * R.col(a).transpose();
    for (std::size_t s = 0; s < 20; ++s) {
      const RowView row{all, s};
      for (std::size_t i = 0; i < row.size(); ++i) {
        EXPECT_LT(((Mat3::Identity() - within) * row.gradient(i)).norm() * kSpacing, 1e-9) << s;
      }
      if (info_.complete != "linear") continue;
      const Vec3 x = block(ConstReals(points), static_cast<std::int32_t>(s));
      EXPECT_LT((row.position(frames) - x).norm(), 1e-9 * kSpacing) << s;
      EXPECT_LT((row.position_gradient(frames) - within).norm(), 1e-8) << s;
    }
  }
};

TEST_P(DegenerateFrames, InOnePlaneServeThePlane) { expect_good_within(2, {6, 5, 1}); }
TEST_P(DegenerateFrames, OnOneLineServeTheLine) { expect_good_within(1, {15, 1, 1}); }

TEST_P(DegenerateFrames, InOnePlaneServePointsBesideIt) {
  const auto frames = test::sample_frames(info_, {6, 5, 1});
  auto points = test::sample_points(20, {6, 5, 1});
  for (std::size_t i = 2; i < points.size(); i += 3) points[i] += 0.4 * kSpacing;
  const FrameWeights all = weights(frames, points);
  expect_partition(all);
  for (std::size_t s = 0; s < 20 && info_.complete == "linear"; ++s) {
    const Vec3 x = block(ConstReals(points), static_cast<std::int32_t>(s));
    const Vec3 left = RowView{all, s}.position(frames) - x;
    EXPECT_LT(left.head<2>().norm(), 1e-9 * kSpacing);
  }
}

TEST_P(DegenerateFrames, AloneMoveEverythingWithThem) {
  ShapeFunctionUse use = test::use_of(info_);
  use.neighbours = info_.takes_neighbours ? 1 : 0;
  const std::vector<double> frame{0.1, 0.2, 0.3};
  const std::vector<double> points{0.1, 0.2, 0.3, 0.15, 0.2, 0.25};
  const FrameWeights all = shape_weights(use, frame, points);
  EXPECT_EQ(all.neighbours, 1);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(all.weights[s], 1.0);
    EXPECT_EQ((RowView{all, s}.gradient(0).norm()), 0.0);
  }
}

// Regular lattices put points as far from several frames as can be: no support may end at all of them.
TEST_P(DegenerateFrames, AsFarFromThePointAllCount) {
  const auto frames = test::frame_lattice({4, 4, 4}, 0.0);
  const std::vector<double> points{0.5 * kSpacing, 0.5 * kSpacing, 0.5 * kSpacing,
                                   1.5 * kSpacing, 1.5 * kSpacing, 1.0 * kSpacing,
                                   1.5 * kSpacing, 1.0 * kSpacing, 1.0 * kSpacing};
  expect_partition(weights(frames, points));
}

TEST_P(DegenerateFrames, FarAwayAreFiniteOrRefused) {
  const auto frames = test::sample_frames(info_);
  for (const double distance : {0.1, 1.0, 10.0, 1e6, 1e150, 1e300}) {
    const std::vector<double> point{distance, 0.5 * distance, -distance};
    try {
      expect_partition(weights(frames, point));
    } catch (const MeshError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("body \"liver\": integration point 0 at ("))
          << error.what();
    }
  }
}

// Sheets, needles, clusters of frames in space, and points at and very near to frames.
TEST_P(DegenerateFrames, CrowdedAreFiniteOrRefused) {
  test::Random random(23);
  for (int cloud = 0; cloud < 60 && !info_.needs_grid; ++cloud) {
    std::vector<double> frames;
    const Vec3 shape(1.0, std::pow(10.0, -(cloud % 10)), std::pow(10.0, -(cloud % 7) - (cloud % 10)));
    for (int i = 0; i < 40; ++i) {
      const Vec3 x = random.vector(kSpacing).cwiseProduct(shape);
      frames.insert(frames.end(), x.begin(), x.end());
    }
    const std::vector<double> far{1.0, 1.0, 1.0, 1.0, 1.0, 2.0};
    frames.insert(frames.end(), far.begin(), far.end());
    for (int i = 0; i < 20; ++i) {
      Vec3 x = block(ConstReals(frames), i);
      if (i > 0) x += random.vector(std::pow(10.0, -i) * kSpacing);
      try {
        expect_partition(weights(frames, {x.data(), 3}));
      } catch (const MeshError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("body \"liver\": ")) << error.what();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(List, DegenerateFrames, testing::ValuesIn(all_shape_functions()),
                         [](const auto& tested) { return test::parameter_name(tested.param); });

}  // namespace
}  // namespace tissu
