#include "tissu/field/shape_function.h"

#include <gtest/gtest.h>

#include <set>

#include "../base/differences.h"
#include "sample_frames.h"

/// What every shape function of the list must do, so that a new one is in these tests by being in the list.
namespace tissu {
namespace {

using test::kSpacing;
using test::RowView;

class EveryShapeFunction : public testing::TestWithParam<ShapeFunctionInfo> {
 protected:
  static constexpr std::size_t kPoints = 60;
  const ShapeFunctionInfo& info_ = GetParam();
  std::vector<double> frames_ = test::sample_frames(info_);
  std::vector<double> points_ = test::sample_points(kPoints);

  FrameWeights at(ConstReals points) const { return at(test::use_of(info_), points); }
  FrameWeights at(const ShapeFunctionUse& use, ConstReals points) const {
    return shape_weights(use, frames_, points);
  }
  /// The function as it comes, and with each number it takes.
  std::vector<ShapeFunctionUse> uses() const {
    std::vector<ShapeFunctionUse> all{test::use_of(info_), test::use_of(info_)};
    all.back().power = 3.5;
    if (info_.takes_neighbours) all.emplace_back(test::use_of(info_)).neighbours = 15;
    if (info_.takes_radius) all.emplace_back(test::use_of(info_)).radius = 1.9 * kSpacing;
    return all;
  }
  void expect_gradients_of(const ShapeFunctionUse& use) const;
};

TEST_P(EveryShapeFunction, SaysWhatItIs) {
  EXPECT_EQ(find_shape_function(info_.name)->name, info_.name);
  EXPECT_GT(info_.neighbours, 0);
  EXPECT_TRUE(info_.complete == "constant" || info_.complete == "linear") << info_.complete;
  EXPECT_TRUE(info_.meaning.ends_with('.'));
}

TEST_P(EveryShapeFunction, HasRowsOfOneLengthWithFramesThatAscend) {
  const FrameWeights all = at(points_);
  EXPECT_EQ(all.neighbours, info_.neighbours);
  const auto k = static_cast<std::size_t>(all.neighbours);
  ASSERT_EQ(all.frames.size(), kPoints * k);
  ASSERT_EQ(all.weights.size(), kPoints * k);
  ASSERT_EQ(all.gradients.size(), 3 * kPoints * k);
  for (std::size_t s = 0; s < kPoints; ++s) {
    const auto numbers = RowView{all, s}.numbers();
    EXPECT_TRUE(std::ranges::is_sorted(numbers, std::less_equal<>())) << s;
    EXPECT_GE(numbers.front(), 0);
    EXPECT_LT(numbers.back(), static_cast<std::int32_t>(frames_.size() / 3));
  }
}

TEST_P(EveryShapeFunction, HasNoRowsForNoPoints) {
  const FrameWeights all = at({});
  EXPECT_EQ(all.neighbours, info_.neighbours);
  EXPECT_TRUE(all.frames.empty() && all.weights.empty() && all.gradients.empty());
}

// Round-off of a few sums of numbers near one, and of gradients near one over a poor cell's height.
TEST_P(EveryShapeFunction, IsAPartitionOfUnity) {
  for (const ShapeFunctionUse& use : uses()) {
    const FrameWeights all = at(use, points_);
    for (std::size_t s = 0; s < kPoints; ++s) {
      const RowView row{all, s};
      EXPECT_NEAR(row.sum(), 1.0, 1e-12) << s;
      EXPECT_LT(row.gradient_sum().norm() * kSpacing, 1e-11) << s;
    }
  }
}

// Differences of fourth order with h = 1e-4 of the spacing: 1e-16 of the fifth derivative, 1e-12 of
// round-off. A point that changes its neighbours within the difference is left out; there are few.
void EveryShapeFunction::expect_gradients_of(const ShapeFunctionUse& use) const {
  const FrameWeights all = at(use, points_);
  std::size_t checked = 0;
  for (std::size_t s = 0; s < kPoints; ++s) {
    const RowView row{all, s};
    const Vec3 x = block(ConstReals(points_), static_cast<std::int32_t>(s));
    for (int axis = 0; axis < 3; ++axis) {
      bool same = true;
      const auto weights_at = [&](double h) -> Eigen::VectorXd {
        const Vec3 moved = x + h * Vec3::Unit(axis);
        const FrameWeights there = at(use, {moved.data(), 3});
        same = same && RowView{there, 0}.numbers() == row.numbers();
        return test::view(there.weights);
      };
      const Eigen::VectorXd difference = test::derivative(weights_at, 1e-4 * kSpacing);
      if (!same) continue;
      ++checked;
      for (std::size_t i = 0; i < row.size(); ++i) {
        EXPECT_NEAR(difference[static_cast<Eigen::Index>(i)] * kSpacing, row.gradient(i)[axis] * kSpacing,
                    1e-8)
            << "point " << s << ", axis " << axis;
      }
    }
  }
  EXPECT_GT(checked, 2 * kPoints);
}

TEST_P(EveryShapeFunction, HasTheGradientsOfItsWeights) {
  for (const ShapeFunctionUse& use : uses()) expect_gradients_of(use);
}

TEST_P(EveryShapeFunction, IsAsCompleteAsItSays) {
  for (const ShapeFunctionUse& use : uses()) {
    const FrameWeights all = at(use, points_);
    double worst = 0.0;
    for (std::size_t s = 0; s < kPoints; ++s) {
      const RowView row{all, s};
      const Vec3 x = block(ConstReals(points_), static_cast<std::int32_t>(s));
      worst = std::max(worst, (row.position(frames_) - x).norm() / kSpacing);
      worst = std::max(worst, (row.position_gradient(frames_) - Mat3::Identity()).norm());
    }
    if (info_.complete == "linear") {
      EXPECT_LT(worst, 1e-9);
    } else {
      EXPECT_GT(worst, 0.1);
    }
  }
}

TEST_P(EveryShapeFunction, IsOneAtItsFrameWhereItInterpolates) {
  const FrameWeights all = at(frames_);
  double worst = 0.0;
  for (std::size_t s = 0; s < frames_.size() / 3; ++s) {
    const RowView row{all, s};
    const auto own = static_cast<std::int32_t>(s);
    EXPECT_NEAR(row.sum(), 1.0, 1e-12);
    EXPECT_LT(row.gradient_sum().norm() * kSpacing, 1e-11);
    worst = std::max(worst, std::abs(row.weight_of(own) - 1.0));
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row.frame(i) != own) worst = std::max(worst, std::abs(row.weight(i)));
    }
  }
  if (info_.interpolates) {
    EXPECT_LT(worst, 1e-12);
  } else {
    EXPECT_GT(worst, 0.01);
  }
}

TEST_P(EveryShapeFunction, DoesNotSeeRigidMotions) {
  test::Random random(3);
  const Mat3 R = info_.needs_grid ? Mat3(Mat3::Identity()) : Mat3(random.rotation().toRotationMatrix());
  const Vec3 t = random.vector(0.1);
  const auto moved = [&](std::vector<double> positions) {
    const auto count = static_cast<std::int32_t>(positions.size() / 3);
    for (std::int32_t i = 0; i < count; ++i) {
      const Vec3 x = R * block(Reals(positions), i) + t;
      block(Reals(positions), i) = x;
    }
    return positions;
  };
  const FrameWeights before = at(points_);
  const FrameWeights after = shape_weights(test::use_of(info_), moved(frames_), moved(points_));
  EXPECT_EQ(before.frames, after.frames);
  for (std::size_t s = 0; s < kPoints; ++s) {
    const RowView a{before, s};
    const RowView b{after, s};
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a.weight(i), b.weight(i), 1e-10) << s;
      EXPECT_LT((R * a.gradient(i) - b.gradient(i)).norm() * kSpacing, 1e-9) << s;
    }
  }
}

// The lists' order is no part of the result, and neither are the other points.
TEST_P(EveryShapeFunction, DependsOnTheFramesAndThePointOnly) {
  const FrameWeights all = at(points_);
  for (std::size_t s = 0; s < kPoints; s += 7) {
    const FrameWeights one = at(ConstReals(points_).subspan(3 * s, 3));
    for (std::size_t i = 0; i < RowView{all, s}.size(); ++i) {
      EXPECT_EQ((RowView{all, s}.frame(i)), (RowView{one, 0}.frame(i)));
      EXPECT_EQ((RowView{all, s}.weight(i)), (RowView{one, 0}.weight(i)));
      EXPECT_EQ((RowView{all, s}.gradient(i)), (RowView{one, 0}.gradient(i)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(List, EveryShapeFunction, testing::ValuesIn(all_shape_functions()),
                         [](const auto& tested) { return test::parameter_name(tested.param); });

TEST(ShapeFunctions, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const ShapeFunctionInfo& info : all_shape_functions()) EXPECT_TRUE(names.insert(info.name).second);
  EXPECT_EQ(find_shape_function("quadratic"), nullptr);
}

}  // namespace
}  // namespace tissu
