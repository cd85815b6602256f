#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sample_frames.h"
#include "tissu/base/error.h"

/// What one function has and another has not, against numbers worked out by hand.
namespace tissu {
namespace {

using test::kSpacing;
using test::RowView;

/// Two frames 1 m apart and a point between, 0.25 m from the first.
const std::vector<double> kTwo{0.0, 0.0, 0.0, 1.0, 0.0, 0.0};
const std::vector<double> kQuarter{0.25, 0.0, 0.0};

// d^-2: 16 and 16/9. w = d_2^2 / (d_1^2 + d_2^2), with s = d_1^2 + d_2^2 = 5/8:
// dw/dX = -2 d_1 d_2 (d_1 + d_2) / s^2 = -0.96.
TEST(Shepard, HasItsValuesBetweenTwoFrames) {
  const FrameWeights all = shape_weights({.name = "shepard", .neighbours = 2}, kTwo, kQuarter);
  EXPECT_NEAR(all.weights[0], 0.9, 1e-15);
  EXPECT_NEAR(all.gradients[0], -0.96, 1e-14);
}

// The others go with d^p: at a frame nothing is left, and on the way there weights and gradients follow.
TEST(Shepard, FollowsItsLimitAtAFrame) {
  const auto frames = test::frame_lattice({3, 3, 3}, 0.2);
  for (const double power : {1.5, 2.0, 4.0}) {
    for (const double d : {0.0, 1e-200, 1e-18, 1e-12, 1e-9, 1e-6}) {
      const Vec3 x = block(ConstReals(frames), 13) + Vec3(d, 0.0, 0.0);
      const double reached = x[0] - frames[39];  // what is left of d beside the coordinate
      const FrameWeights all = shape_weights({.neighbours = 6, .power = power}, frames, {x.data(), 3});
      const RowView row{all, 0};
      EXPECT_NEAR(row.weight_of(13), 1.0, 10.0 * std::pow(reached / kSpacing, power)) << d;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double limit = 10.0 * power * std::pow(reached / kSpacing, power - 1.0);
        EXPECT_LE(row.gradient(i).norm() * kSpacing, limit) << power << ' ' << d;
      }
    }
  }
  const std::vector<double> origin{0.0, 0.0, 0.0};
  const std::vector<double> nearly{1e-160, 0.0, 0.0};
  for (const auto& point : {origin, nearly}) {
    const FrameWeights all = shape_weights({.neighbours = 2, .power = 3.0}, kTwo, point);
    EXPECT_EQ(all.weights, (std::vector<double>{1.0, 0.0}));
    for (const double g : all.gradients) EXPECT_EQ(g, 0.0);
  }
}

/// Against sorting all frames by distance, then number.
void expect_nearest(ConstReals frames, ConstReals points, int neighbours) {
  const FrameWeights all = shape_weights({.neighbours = neighbours}, frames, points);
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(points.size() / 3); ++s) {
    std::vector<std::pair<double, std::int32_t>> by_distance;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(frames.size() / 3); ++i) {
      by_distance.emplace_back((block(frames, i) - block(points, s)).squaredNorm(), i);
    }
    std::ranges::sort(by_distance);
    std::vector<std::int32_t> nearest;
    for (std::size_t i = 0; i < all.frames.size() / (points.size() / 3); ++i)
      nearest.push_back(by_distance[i].second);
    std::ranges::sort(nearest);
    EXPECT_EQ((RowView{all, static_cast<std::size_t>(s)}.numbers()), nearest) << s;
  }
}

TEST(Shepard, ListensToTheNearestFrames) {
  expect_nearest(test::Random(3).numbers(std::size_t{3} * 500),
                 test::Random(4).numbers(std::size_t{3} * 100, 1.3), 9);
}

// Half and whole coordinates: many frames are as far to the last bit, also across the splits of the tree.
TEST(Shepard, TakesTheLowerNumbersOfFramesAsFar) {
  std::vector<double> frames;
  std::vector<double> points;
  for (int i = 0; i < 512; ++i) {
    const std::array<double, 3> x{static_cast<double>(i * 5 % 8), static_cast<double>(i / 8 * 3 % 8),
                                  static_cast<double>(i / 64)};
    frames.insert(frames.end(), x.begin(), x.end());
    for (const double a : x) points.push_back(a + (i % 2 == 0 ? 0.5 : 0.0));
  }
  for (const int neighbours : {4, 9}) expect_nearest(frames, points, neighbours);
}

// (1 - r)^4 (4 r + 1): 0.6328125 at 1/4, 0.015625 at 3/4.
TEST(Wendland, HasItsValuesBetweenTwoFrames) {
  const FrameWeights all =
      shape_weights({.name = "wendland", .neighbours = 2, .radius = 1.0}, kTwo, kQuarter);
  EXPECT_NEAR(all.weights[0], 0.6328125 / (0.6328125 + 0.015625), 1e-15);
}

// 2/3 - 4 r^2 + 4 r^3 = 23/48 at 1/4, 4/3 (1 - r)^3 = 1/48 at 3/4.
TEST(CubicSpline, HasItsValuesBetweenTwoFrames) {
  const FrameWeights all =
      shape_weights({.name = "cubic_spline", .neighbours = 2, .radius = 1.0}, kTwo, kQuarter);
  EXPECT_NEAR(all.weights[0], 23.0 / 24.0, 1e-15);
}

// At the centroid of a regular tetrahedron each corner x_i counts a quarter, and dw_i/dX = x_i / 4: along the
// height, 4 / sqrt(3), one over it.
TEST(Linear, IsBarycentric) {
  const std::vector<double> corners{1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
  const std::vector<double> centroid{0, 0, 0};
  const FrameWeights all = shape_weights({.name = "linear"}, corners, centroid);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(all.weights[i], 0.25, 1e-15);
    const Vec3 gradient = RowView{all, 0}.gradient(i);
    EXPECT_NEAR((gradient - 0.25 * block(ConstReals(corners), static_cast<std::int32_t>(i))).norm(), 0.0,
                1e-15);
  }
}

TEST(Linear, ContainsThePointsAmongItsFrames) {
  const auto frames = test::frame_lattice({7, 7, 7}, 0.3);
  auto points = test::sample_points(500, {4, 4, 4});
  for (double& x : points) x += 1.5 * kSpacing;
  const FrameWeights all = shape_weights({.name = "linear"}, frames, points);
  std::size_t outside = 0;
  for (std::size_t s = 0; s < 500; ++s) {
    double least = 0.0;
    double steepest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      least = std::min(least, RowView{all, s}.weight(i));
      steepest = std::max(steepest, RowView{all, s}.gradient(i).norm());
    }
    outside += least < -1e-9 ? 1 : 0;
    EXPECT_GT(least, -0.2);
    EXPECT_LT(steepest * kSpacing, 8.0);  // heights above an eighth of the spacing
  }
  EXPECT_LE(outside, 10U);
}

// With four neighbours in space a fit has no freedom: whatever the window, it is barycentric.
TEST(MovingLeastSquares, OfFourNeighboursIsBarycentric) {
  const std::vector<double> corners{0, 0, 0, 1.2, 0.1, 0, 0.2, 0.9, 0.1, 0.1, 0.2, 1.1};
  const std::vector<double> point{0.3, 0.25, 0.2};
  const FrameWeights linear = shape_weights({.name = "linear"}, corners, point);
  const FrameWeights fit = shape_weights({.name = "moving_least_squares", .neighbours = 4}, corners, point);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(linear.weights[i], fit.weights[i], 1e-13);
    EXPECT_LT((RowView{linear, 0}.gradient(i) - RowView{fit, 0}.gradient(i)).norm(), 1e-12);
  }
}

// A sheet of frames and one far above: near the sheet the fit is complete in the sheet, and flat across it.
TEST(MovingLeastSquares, IsCompleteInTheSpanOfItsNeighbours) {
  auto frames = test::frame_lattice({6, 6, 1}, 0.2);
  frames.insert(frames.end(), {0.0, 0.0, 1.0});
  const std::vector<double> point{0.024, 0.027, 0.0};
  const FrameWeights all = shape_weights({.name = "moving_least_squares"}, frames, point);
  const RowView row{all, 0};
  EXPECT_LT((row.position(frames) - Vec3(0.024, 0.027, 0.0)).norm(), 1e-15);
  const Mat3 plane = Vec3(1.0, 1.0, 0.0).asDiagonal();
  EXPECT_LT((row.position_gradient(frames) - plane).norm(), 1e-11);
}

}  // namespace
}  // namespace tissu
