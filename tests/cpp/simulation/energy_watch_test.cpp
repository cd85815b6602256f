#include "tissu/simulation/energy_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../world/sample_worlds.h"

/// Where energy can only be kept or lost it is watched; whatever may give energy ends that.
namespace tissu {
namespace {

class Watched : public testing::Test {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}, Split::six);
  WorldDescription description_ = closed();

  WorldDescription closed() const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {.law = "stvk", .young = 100.0})};
    world.bodies[0].rayleigh = {0.1, 0.001};
    world.gravity = Vec3(0, 0, -1);
    world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
    world.loads = {{"hand", "body", {3}, {0.1, 0.0, 0.0}, {}}};
    return world;
  }
  [[nodiscard]] bool is_watched() const { return EnergyWatch::can_watch(World(description_)); }
};

TEST_F(Watched, GravityDampingAndLoadsThatStay) { EXPECT_TRUE(is_watched()); }

TEST_F(Watched, NoLoadThatChangesWithTime) {
  description_.loads[0].history = {{0.0, 1.0}, {0.0, 1.0}};
  EXPECT_FALSE(is_watched());
}

TEST_F(Watched, NoPressure) {
  description_.pressures = {{"inside", "body", {{"triangle", {0, 1, 2}}}, 10.0, {}}};
  EXPECT_FALSE(is_watched());
}

TEST_F(Watched, NoMaterialThatRemembers) {
  description_.bodies[0].viscosity = {0.0, 0.0, 0.0, {{0.5, 0.1}}};
  EXPECT_FALSE(is_watched());
}

TEST_F(Watched, LinksAndGrabsThatAreChangedBetweenStepsAlone) {
  description_.links = description_.grabbing = true;
  EXPECT_TRUE(is_watched());
}

TEST_F(Watched, NoNodesThatAreLed) {
  Motion motion;
  motion.times = {0.0, 1.0};
  motion.angles = {0.0, 0.0};
  motion.displacements = {Vec3::Zero(), Vec3(0.1, 0.0, 0.0)};
  description_.fixed[0].motion = motion;
  EXPECT_FALSE(is_watched());
}

// A force that is changed between two steps takes its potential with it: no gain of the method.
TEST_F(Watched, DoesNotCountALoadThatIsChanged) {
  description_.loads[0].nodes = {2};
  const World world(description_);
  State state = world.rest_state();
  for (double& v : state.velocities) v = 0.1;  // 4 kg that move: 0.06 J
  EnergyWatch watch;
  watch.begin(world, state);
  watch.end(world, state);
  memory_of(world, state, "hand") = {0.0, 1.0, 0.0, 0.0, 0.0, -100.0, 0.0, 0.0};  // 2 m: 200 J
  watch.begin(world, state);
  watch.end(world, state);
  EXPECT_EQ(watch.growth(), 0.0);
}

// A step that gained 6 % is followed by a write that takes 2 % away, and by one that takes all but 4 %.
TEST_F(Watched, WhatIsTakenAwayMayBeWhatWasGained) {
  description_.gravity = Vec3::Zero();
  description_.loads.clear();
  const World world(description_);
  State state = world.rest_state();
  const auto move_with = [&](double share) { std::ranges::fill(state.velocities, std::sqrt(share)); };
  EnergyWatch watch;
  move_with(1.0);
  watch.begin(world, state);
  move_with(1.06);
  watch.end(world, state);
  EXPECT_NEAR(watch.growth(), 0.06, 1e-12);
  move_with(1.04);  // the largest that there was, as far as is known
  watch.begin(world, state);
  watch.end(world, state);
  EXPECT_NEAR(watch.growth(), 0.04 / 1.04, 1e-12);
  move_with(0.04);
  watch.begin(world, state);
  watch.end(world, state);
  EXPECT_EQ(watch.growth(), 0.0);
}

// A body at rest, to the last digits of its places: energies of round-off may double.
TEST_F(Watched, RoundOffIsNoGrowth) {
  description_.gravity = Vec3::Zero();
  description_.loads.clear();
  const World world(description_);
  State state = world.rest_state();
  EnergyWatch watch;
  watch.ignore_round_off(world, 0.01);
  watch.begin(world, state);
  std::ranges::fill(state.velocities, 1e-14 / 0.01);
  watch.end(world, state);
  EXPECT_LT(watch.growth(), 1e-6);
  EXPECT_GT(watch.growth(), 0.0);
}

// The sums go on, and so does what is known of the end of the latest step.
TEST_F(Watched, GoesOnFromItsReference) {
  const World world(description_);
  State state = world.rest_state();
  EnergyWatch watch;
  watch.begin(world, state);
  for (double& v : state.velocities) v = 0.1;
  watch.end(world, state);
  const auto step = [&](EnergyWatch& one, State now, double written) {
    for (double& x : now.positions) x += written;
    one.begin(world, now);
    for (double& v : now.velocities) v *= 1.1;
    one.end(world, now);
    return one.growth();
  };
  for (const double written : {0.0, 0.01}) {
    EnergyWatch same = watch;
    EnergyWatch other;
    other.restore(watch.reference(state), state);
    const double growth = step(same, state, written);
    EXPECT_GT(growth, 0.0);
    EXPECT_EQ(step(other, state, written), growth);
  }
}

}  // namespace
}  // namespace tissu
