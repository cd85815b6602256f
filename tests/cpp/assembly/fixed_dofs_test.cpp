#include "tissu/assembly/fixed_dofs.h"

#include <gtest/gtest.h>

#include <numbers>

namespace tissu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRoundOff = 1e-15;  // of numbers of size 1 to 5

TEST(Motion, IsAtRestWithoutTimes) { EXPECT_EQ(Motion{}.position(Vec3(1, 2, 3), 7.0), Vec3(1, 2, 3)); }

TEST(Motion, DisplacesLinearlyAndIsHeldAtItsEnds) {
  Motion motion;
  motion.times = {1.0, 3.0};
  motion.displacements = {Vec3(0, 0, 1), Vec3(2, 0, 0)};
  motion.angles = {0.0, 0.0};
  const Vec3 X(1, 2, 3);
  EXPECT_LT((motion.position(X, 0.0) - Vec3(1, 2, 4)).norm(), kRoundOff);
  EXPECT_LT((motion.position(X, 1.5) - Vec3(1.5, 2, 3.75)).norm(), kRoundOff);
  EXPECT_LT((motion.position(X, 3.0) - Vec3(3, 2, 3)).norm(), kRoundOff);
  EXPECT_LT((motion.position(X, 1e6) - Vec3(3, 2, 3)).norm(), kRoundOff);
}

TEST(Motion, TurnsAboutTheAxisThroughTheCenter) {
  Motion motion;
  motion.times = {0.0, 1.0};
  motion.displacements = {Vec3::Zero(), Vec3::Zero()};
  motion.angles = {0.0, kPi};
  motion.center = Vec3(1, 1, 0);
  motion.axis = Vec3::UnitZ();
  const Vec3 X(2, 1, 5);
  EXPECT_LT((motion.position(X, 1.0) - Vec3(0, 1, 5)).norm(), kRoundOff);
  EXPECT_LT((motion.position(X, 0.5) - Vec3(1, 2, 5)).norm(),
            kRoundOff);  // anticlockwise seen from the axis' tip
  const double half = std::sqrt(0.5);
  EXPECT_LT((motion.position(X, 0.25) - Vec3(1 + half, 1 + half, 5)).norm(), kRoundOff);
}

/// Ten turns are an angle of 20 pi, not of none: between their ends the body goes all the way.
TEST(Motion, TurnsMoreThanOnce) {
  Motion motion;
  motion.times = {0.0, 10.0};
  motion.displacements = {Vec3::Zero(), Vec3::Zero()};
  motion.angles = {0.0, 20.0 * kPi};
  motion.axis = Vec3::UnitX();
  EXPECT_LT((motion.position(Vec3(0, 1, 0), 0.25) - Vec3(0, 0, 1)).norm(), kRoundOff);
  EXPECT_LT((motion.position(Vec3(0, 1, 0), 5.5) - Vec3(0, -1, 0)).norm(),
            1e-14);  // 11 pi, to its own round-off
}

TEST(Motion, TurnsFirstAndThenDisplaces) {
  Motion motion;
  motion.times = {0.0};
  motion.displacements = {Vec3(10, 0, 0)};
  motion.angles = {kPi / 2};
  motion.axis = Vec3::UnitZ();
  EXPECT_LT((motion.position(Vec3(1, 0, 0), 0.0) - Vec3(10, 1, 0)).norm(), kRoundOff);
}

class FixedDofsTest : public testing::Test {
 protected:
  FixedDofsTest() {
    Motion rising;
    rising.times = {0.0, 1.0};
    rising.displacements = {Vec3::Zero(), Vec3(1, 2, 3)};
    rising.angles = {0.0, 0.0};
    fixed_.add(std::vector<std::int32_t>{3}, rest_, FixedDofs::kAllAxes, {});
    fixed_.add(std::vector<std::int32_t>{1}, rest_, 5, rising);  // x and z
  }
  static State at(const std::vector<double>& x) {
    State state;
    state.positions = x;
    return state;
  }
  std::vector<double> rest_ = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
  FixedDofs fixed_{4};
};

TEST_F(FixedDofsTest, ListsItsRows) {
  EXPECT_FALSE(fixed_.empty());
  EXPECT_TRUE(FixedDofs(4).empty());
  EXPECT_TRUE(FixedDofs().empty());
  EXPECT_EQ(fixed_.rows(), (std::vector<std::int32_t>{1, 3}));
  EXPECT_EQ(fixed_.masks(), (std::vector<std::uint8_t>{0, 5, 0, 7}));
}

TEST_F(FixedDofsTest, VelocitiesLeadToTheTarget) {
  const std::vector<double> x = {0, 0, 0, 1.5, 1, 1, 2, 2, 2, 3, 3.25, 3};
  std::vector<double> v(12, 9.0);
  fixed_.set_velocities(at(x), 0.5, 0.25, 1.0, v);
  // node 1 goes to x = 1.5, z = 2.5; node 3 back to rest; the rest is left alone
  EXPECT_EQ(v, (std::vector<double>{9, 9, 9, 0, 9, 6, 9, 9, 9, 0, -1, 0}));
  std::ranges::fill(v, 9.0);
  fixed_.set_velocities(at(x), 0.5, 0.25, 0.5, v);  // half of the way
  EXPECT_EQ(v, (std::vector<double>{9, 9, 9, 0, 9, 3, 9, 9, 9, 0, -0.5, 0}));
}

TEST_F(FixedDofsTest, ClearsTheLedComponentsOnly) {
  std::vector<double> values(12, 1.0);
  fixed_.clear(values);
  EXPECT_EQ(values, (std::vector<double>{1, 1, 1, 0, 1, 0, 1, 1, 1, 0, 0, 0}));
}

/// The axes of one node may be held by different parts.
TEST_F(FixedDofsTest, GathersAxes) {
  fixed_.add(std::vector<std::int32_t>{1}, rest_, 2, {});
  EXPECT_EQ(fixed_.masks()[1], 7);
  EXPECT_EQ(fixed_.rows(), (std::vector<std::int32_t>{1, 3}));
  std::vector<double> v(12, 9.0);
  fixed_.set_velocities(at(rest_), 1.0, 1.0, 1.0, v);
  EXPECT_EQ(v, (std::vector<double>{9, 9, 9, 1, 0, 3, 9, 9, 9, 0, 0, 0}));
}

/// Held about y and z: what turns about x is left alone, here and by place().
TEST_F(FixedDofsTest, HoldsTurningAboutSomeAxes) {
  fixed_.hold_turning(std::vector<std::int32_t>{2}, 6);
  EXPECT_EQ(fixed_.masks()[2], 6);
  std::vector<double> v(12, 9.0);
  fixed_.set_velocities(at(rest_), 1.0, 1.0, 1.0, v);
  EXPECT_EQ(v[6], 9.0);
  EXPECT_EQ(v[7], 0.0);
  EXPECT_EQ(v[8], 0.0);
  State to = at(rest_);
  to.positions[6] = 7.0;
  fixed_.place(at(rest_), 1.0, v, to);
  EXPECT_EQ(to.positions[6], 7.0);
}

TEST(Interpolate, IsTheEmptyValueWithoutATable) { EXPECT_EQ(interpolate({}, {}, 1.0, 4.0), 4.0); }

}  // namespace
}  // namespace tissu
