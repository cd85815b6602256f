#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "../base/differences.h"
#include "methods.h"

/// A support with live targets goes as one whose motion the scene gives.
namespace tissu {
namespace {

class LiveLeadOf : public testing::TestWithParam<test::Method> {};

const Mesh kMesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {6, 2, 2}, Split::six);

Motion half_turn() {
  Motion motion;
  motion.times = {0.0, 0.5};
  motion.displacements = {Vec3::Zero(), Vec3(0.4, 0.1, -0.2)};
  motion.angles = {0.0, std::numbers::pi};
  motion.center = Vec3(0.0, 0.5, 0.5);
  motion.axis = Vec3(1.0, 0.0, 0.0);
  return motion;
}

/// Held at x = 0; the end at x = 3 is led, or has a name.
WorldDescription bar(const Motion& motion, std::string name, std::uint8_t axes = FixedDofs::kAllAxes) {
  WorldDescription world;
  world.bodies = {test::body_of(kMesh, {.law = "stvk", .young = 200.0})};
  world.fixed = {test::fixed(test::nodes_at(kMesh, 0, 0.0)),
                 test::fixed(test::nodes_at(kMesh, 0, 3.0), axes)};
  world.fixed[1].motion = motion;
  world.fixed[1].name = std::move(name);
  return world;
}

void lead(Simulation& simulation, const Pose& pose, double over = 0.0) {
  simulation.world().fixed().lead_to("hand", pose, over, simulation.state());
}

double farthest(const Simulation& a, const Simulation& b) {
  return (test::view(a.state().positions) - test::view(b.state().positions)).cwiseAbs().maxCoeff();
}

TEST_P(LiveLeadOf, FollowsThePathOfAMotion) {
  const Motion motion = half_turn();
  Simulation given = test::simulate(bar(motion, ""), GetParam().make());
  Simulation live = test::simulate(bar({}, "hand"), GetParam().make());
  const double h = std::min(0.01, 0.02 * given.stable_step());
  for (int i = 0; i < 20; ++i) {
    lead(live, motion.pose(live.state().time + h));
    given.step(h);
    live.step(h);
    // Stages within a step: the same place by another sum, two roundings of numbers below 4.
    ASSERT_LT(farthest(given, live), 1e-13) << "step " << i;
    if (GetParam().name != "rk2" && GetParam().name != "rk4") {
      ASSERT_EQ(given.state().positions, live.state().positions) << "step " << i;
      ASSERT_EQ(given.state().velocities, live.state().velocities);
      ASSERT_EQ(given.reactions(), live.reactions());
    }
  }
}

/// One target at the end of the motion, reached after its duration by the same arc and at its rate.
TEST_P(LiveLeadOf, GoesALongWayAtAConstantRate) {
  const Motion motion = half_turn();
  Simulation given = test::simulate(bar(motion, ""), GetParam().make());
  Simulation live = test::simulate(bar({}, "hand"), GetParam().make());
  const double h = std::min(0.01, 0.02 * given.stable_step());
  lead(live, motion.pose(1.0), motion.times.back());
  for (int i = 0; i < 20; ++i) {
    given.step(h);
    live.step(h);
    ASSERT_LT(farthest(given, live), 1e-13) << "step " << i;
  }
}

/// Back on its own path, a motion, it is where that motion is, with its velocity.
TEST_P(LiveLeadOf, GoesBackToItsOwnPath) {
  const Motion motion = half_turn();
  Simulation live = test::simulate(bar(motion, "hand"), GetParam().make());
  const double h = std::min(0.01, 0.02 * live.stable_step());
  Pose aside = motion.pose(0.0);
  aside.displacement = Vec3(0.0, 0.02, 0.0);
  lead(live, aside);
  live.step(h);
  const FixedDofs& fixed = live.world().fixed();
  EXPECT_TRUE(fixed.is_led_live("hand", live.state()));
  fixed.release("hand", 3.0 * h, live.state());
  EXPECT_FALSE(fixed.is_led_live("hand", live.state()));
  for (int i = 0; i < 6; ++i) live.step(h);
  EXPECT_TRUE(live.memory("lead of hand").empty());
  for (const std::int32_t node : test::nodes_at(kMesh, 0, 3.0)) {
    const Vec3 now = motion.position(kMesh.node(node), live.state().time);
    const Vec3 before = motion.position(kMesh.node(node), live.state().time - h);
    EXPECT_LT((block(ConstReals(live.state().positions), node) - now).norm(), 2e-15);
    EXPECT_LT((block(ConstReals(live.state().velocities), node) - (now - before) / h).norm(), 2e-15 / h);
  }
}

/// What is never led live has the bits of a world in which it cannot be.
TEST_P(LiveLeadOf, ANameAloneChangesNothing) {
  Simulation plain = test::simulate(bar(half_turn(), ""), GetParam().make());
  Simulation named = test::simulate(bar(half_turn(), "hand"), GetParam().make());
  const double h = std::min(0.01, 0.02 * plain.stable_step());
  for (int i = 0; i < 5; ++i) {
    plain.step(h);
    named.step(h);
  }
  EXPECT_EQ(plain.state().positions, named.state().positions);
  EXPECT_EQ(plain.state().velocities, named.state().velocities);
}

INSTANTIATE_TEST_SUITE_P(Methods, LiveLeadOf, testing::ValuesIn(test::all_methods()),
                         testing::PrintToStringParamName());

std::unique_ptr<Integrator> equilibrium() {
  StaticEquilibrium::Settings settings;
  settings.newton = {40, 1e-10};
  return std::make_unique<StaticEquilibrium>(settings);
}

/// Half a turn in one static step, by its arc: the bar is twisted, not drawn through its own axis.
TEST(LiveLead, TurnsByItsArcInAStaticStep) {
  const Motion motion = half_turn();
  Simulation given = test::simulate(bar(motion, ""), equilibrium());
  Simulation live = test::simulate(bar({}, "hand"), equilibrium());
  lead(live, motion.pose(0.5));
  ASSERT_TRUE(given.step(0.5).converged);
  ASSERT_TRUE(live.step(0.5).converged);
  // Newton's tolerance, over what the bar's softest mode has of its stiffness.
  EXPECT_LT(farthest(given, live), 1e-6);
  for (const std::int32_t node : test::nodes_at(kMesh, 0, 3.0)) {
    const Vec3 there = motion.position(kMesh.node(node), 0.5);
    EXPECT_LT((block(ConstReals(live.state().positions), node) - there).norm(), 1e-14);
  }
}

TEST(LiveLead, LeadsItsOwnAxesOnly) {
  Simulation live = test::simulate(bar({}, "hand", 1), equilibrium());
  Pose pose;
  pose.displacement = Vec3(0.3, 5.0, 5.0);
  lead(live, pose);
  ASSERT_TRUE(live.step(1.0).converged);
  for (const std::int32_t node : test::nodes_at(kMesh, 0, 3.0)) {
    const Vec3 moved = block(ConstReals(live.state().positions), node) - kMesh.node(node);
    EXPECT_NEAR(moved.x(), 0.3, 1e-15);
    EXPECT_LT(moved.tail<2>().norm(), 0.1);
  }
}

/// A whole turn and a half from where a way before has left it: angles count turns.
TEST(LiveLead, CountsTurns) {
  Simulation live = test::simulate(bar({}, "hand"), test::implicit_euler());
  const double h = 0.01;
  Pose pose = half_turn().pose(0.5);
  lead(live, pose, h);
  live.step(h);
  pose.angle = 4.0 * std::numbers::pi;
  lead(live, pose, 3.0);
  live.step(h);
  const double angle = std::numbers::pi * (1.0 + 3.0 * h / 3.0);
  const Pose there{pose.center, pose.displacement, pose.axis, angle};
  for (const std::int32_t node : test::nodes_at(kMesh, 0, 3.0)) {
    EXPECT_LT((block(ConstReals(live.state().positions), node) - there.position(kMesh.node(node))).norm(),
              1e-13);
  }
}

TEST(LiveLead, RefusesWhatItCannotRead) {
  Simulation live = test::simulate(bar({}, "hand"), test::implicit_euler());
  EXPECT_THROW(live.world().fixed().lead_to("foot", Pose{}, 0.0, live.state()), ParameterError);
  EXPECT_THROW(lead(live, Pose{}, -1.0), ParameterError);
  EXPECT_THROW(live.world().fixed().lead_to("hand", std::vector<double>{1.0}, 0.0, live.state()),
               ParameterError);
  EXPECT_TRUE(live.memory("lead of hand").empty());
  lead(live, Pose{});
  check_memory(live.world(), live.state());
  live.memory("lead of hand")[0] = 7.0;
  EXPECT_THROW(check_memory(live.world(), live.state()), ParameterError);
  live.memory("lead of hand") = {1.0, 2.0};
  EXPECT_THROW(check_memory(live.world(), live.state()), ParameterError);
}

}  // namespace
}  // namespace tissu
