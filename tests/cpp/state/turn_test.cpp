#include <gtest/gtest.h>

#include <numbers>

#include "../base/random.h"
#include "tissu/assembly/fixed_dofs.h"
#include "tissu/state/state.h"

namespace tissu {
namespace {

TEST(Turn, IsFoundAgainWithItsWholeTurns) {
  test::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 w = random.vector(10.0);
    const Vec3 found = nearest_turn(turn_by(w), w + random.vector(0.5));
    EXPECT_LE((found - w).norm(), 1e-13 * (1.0 + w.norm() * w.norm()));
  }
}

TEST(Turn, OfHalfATurnGoesTheExpectedWay) {
  for (const double sign : {1.0, -1.0}) {
    const Vec3 w = sign * std::numbers::pi * Vec3::UnitY();
    EXPECT_LE((nearest_turn(turn_by(w), 0.9 * w) - w).norm(), 1e-13);
  }
}

TEST(Turn, OfNothingIsNothing) {
  EXPECT_EQ(nearest_turn(Quaternion::Identity(), Vec3::Zero()), Vec3::Zero());
  EXPECT_EQ(turn_by(Vec3::Zero()).coeffs(), Quaternion::Identity().coeffs());
}

/// A led rotation is where its motion says after the step that its velocity takes.
TEST(LedRotation, ArrivesAfterTheStep) {
  Motion motion;
  motion.times = {0.0, 1.0};
  motion.displacements = {Vec3::Zero(), Vec3::Zero()};
  motion.angles = {0.0, 5.0 * std::numbers::pi};
  motion.axis = Vec3(0.6, 0.0, 0.8);
  FixedDofs fixed(2);
  State state;
  state.positions.assign(6, 0.0);
  state.velocities.assign(6, 0.0);
  const Quaternion rest(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  state.rotations = {rest};
  const std::vector<std::int32_t> blocks = {1};
  const std::vector<std::int32_t> frames = {0};
  fixed.add_rotations(blocks, frames, state.rotations, motion);
  EXPECT_EQ(fixed.masks()[1], FixedDofs::kAllAxes);
  const double h = 0.2;  // half a turn
  std::vector<double> v(6, 0.0);
  for (int n = 1; n <= 5; ++n) {
    const State from = state;
    fixed.set_velocities(from, n * h, h, 1.0, v);
    EXPECT_LE((block(Reals(v), 1) - 5.0 * std::numbers::pi * motion.axis).norm(), 1e-9);
    fixed.place(from, h, v, state);
    const Quaternion wanted = turn_by(motion.angle(n * h) * motion.axis) * rest;
    EXPECT_LE(state.rotations[0].angularDistance(wanted), 1e-9);
  }
}

}  // namespace
}  // namespace tissu
