#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "../base/differences.h"
#include "sample_worlds.h"

/// Rigid frames in the state, the matrix and the integrator that mesh nodes use.
namespace tissu {
namespace {

Mat3 inertia() {
  Mat3 I;
  I << 2.0, 0.1, 0.2, 0.1, 3.0, 0.3, 0.2, 0.3, 4.0;
  return I;
}

FrameDescription spinning() {
  FrameDescription frame;
  frame.rotation = Quaternion(0.3, -0.5, 0.7, 0.2);
  frame.mass = 2.5;
  frame.inertia = inertia();
  frame.velocity = Vec3(1, 2, 3);
  frame.angular_velocity = Vec3(1.0, -2.0, 0.5);  // no principal axis
  return frame;
}

Vec3 angular_momentum(const Simulation& simulation) {
  const Frame& frame = simulation.world().frames()[0];
  return spatial_inertia(frame, simulation.state().rotations[0]) *
         block(ConstReals(simulation.state().velocities), frame.block + 1);
}

class FrameTest : public testing::TestWithParam<int> {
 protected:
  static Simulation run(WorldDescription world) {
    return test::simulate(std::move(world), test::implicit_euler(GetParam(), 1e-12));
  }
};

/// Backward Euler of a fall: v_n = v_0 + n h g, x_n = h (n v_0 + n (n + 1) / 2 h g).
TEST_P(FrameTest, FallsAndSpinsFromTheOrigin) {
  WorldDescription world;
  world.frames = {spinning()};
  const Vec3 g(0.0, 0.0, -9.81);
  world.gravity = g;
  Simulation simulation = run(world);
  const Vec3 L = angular_momentum(simulation);
  const double h = 1e-3;
  for (int n = 1; n <= 1000; ++n) {
    simulation.step(h);
    // Round-off of 1e-16 in each of a thousand steps.
    ASSERT_LT((angular_momentum(simulation) - L).norm(), 1e-12 * L.norm()) << "step " << n;
  }
  const State& state = simulation.state();
  const Vec3 v0(1, 2, 3);
  EXPECT_LT((block(ConstReals(state.velocities), 0) - (v0 + g)).norm(), 1e-12);
  EXPECT_LT((block(ConstReals(state.positions), 0) - (v0 + 0.5 * 1001.0 * h * g)).norm(), 1e-12);
  EXPECT_EQ(block(ConstReals(state.positions), 1), Vec3::Zero());
  EXPECT_NEAR(state.rotations[0].norm(), 1.0, 1e-15);
  EXPECT_GT((block(ConstReals(state.velocities), 1) - Vec3(1.0, -2.0, 0.5)).norm(), 0.1);  // it tumbles
}

/// A symmetric top without moment: its axis goes round L at the rate |L| / I_1. The midpoint rule on
/// the rotations is of second order.
TEST_P(FrameTest, SymmetricTopPrecesses) {
  const auto error = [&](int steps) {
    WorldDescription world;
    FrameDescription top;
    top.inertia = Vec3(2.0, 2.0, 3.0).asDiagonal();
    top.angular_velocity = Vec3(1.0, 0.0, 2.0);
    world.frames = {top};
    Simulation simulation = run(world);
    for (int i = 0; i < steps; ++i) simulation.step(1.0 / steps);
    const Vec3 L(2.0, 0.0, 6.0);
    const Vec3 expected = Eigen::AngleAxisd(L.norm() / 2.0, L.normalized()) * Vec3::UnitZ();
    return (simulation.state().rotations[0] * Vec3::UnitZ() - expected).norm();
  };
  const double coarse = error(500);
  EXPECT_LT(coarse, 1e-5);
  EXPECT_NEAR(coarse / error(1000), 4.0, 0.1);
}

/// Energy of a free top: the angular momentum is kept, so it stays between |L|^2 / 2 I_3 and |L|^2 / 2 I_1.
TEST_P(FrameTest, SpinKeepsItsEnergyToTheSquareOfTheStep) {
  const auto drift = [&](int steps) {
    WorldDescription world;
    world.frames = {spinning()};
    Simulation simulation = run(world);
    const double before = simulation.energy().kinetic;
    for (int i = 0; i < steps; ++i) simulation.step(1.0 / steps);
    return std::abs(simulation.energy().kinetic - before) / before;
  };
  EXPECT_LT(drift(1000), 1e-4);
  EXPECT_LT(drift(2000), 0.3 * drift(1000) + 1e-13);
}

/// A soft block held at its top, a frame tied below it by a point of its own, hanging like a pendulum.
class TiedFrame : public FrameTest {
 protected:
  TiedFrame() {
    world_.bodies = {test::body_of(mesh_, {.young = 2e3})};
    world_.fixed = {test::fixed(test::nodes_at(mesh_, 2, 1.0))};
    world_.gravity = Vec3(0.0, 0.0, -9.81);
    world_.links = true;
    FrameDescription frame;
    frame.mass = 0.5;
    frame.inertia = Vec3(0.02, 0.03, 0.04).asDiagonal();
    frame.position = mesh_.node(node_) - place_;  // tied where it is, swings out of the level
    world_.frames = {frame};
  }
  std::int32_t tie(Simulation& simulation) const {
    return test::links(simulation).add({mesh_.node_count(), 0, place_}, {node_}, kStiffness);
  }
  double gap(const State& state) const {
    const Vec3 origin = block(ConstReals(state.positions), mesh_.node_count());
    return (origin + state.rotations[0] * place_ - block(ConstReals(state.positions), node_)).norm();
  }
  static constexpr double kStiffness = 1e5;
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(1, 1, 1), {2, 2, 2}, Split::six);
  std::int32_t node_ = 0;
  Vec3 place_ = Vec3(0.4, 0.1, 0.0);
  WorldDescription world_;
};

TEST_P(TiedFrame, SwingsLikeAPendulum) {
  Simulation simulation = run(world_);
  tie(simulation);
  const double first = simulation.energy().total();
  double lowest = 0.0;
  for (int i = 0; i < 600; ++i) {
    simulation.step(0.005);
    // The tie carries the weight, 5 N, and the pull of the swing, less than ten times as much.
    ASSERT_LT(gap(simulation.state()), 10.0 * 5.0 / kStiffness) << "step " << i;
    const Vec3 origin = block(ConstReals(simulation.state().positions), mesh_.node_count());
    ASSERT_LT(origin.norm(), 1.5) << "step " << i;
    lowest = std::min(lowest, origin.z());
  }
  EXPECT_LT(lowest, -0.2);  // it fell as far as its arm of 0.41 m lets it, or half of that
  EXPECT_LT(simulation.energy().total(), first);
  EXPECT_TRUE(test::view(simulation.state().positions).allFinite());
}

/// The pull reaches the block: it gives way, and comes to rest with the weight of the frame below its node.
TEST_P(TiedFrame, PullsTheBody) {
  world_.bodies[0].rayleigh = {2.0, 0.01};
  Simulation with = run(world_);
  tie(with);
  Simulation without = run(world_);
  for (int i = 0; i < 200; ++i) {
    with.step(0.01);
    without.step(0.01);
  }
  EXPECT_LT(with.state().positions[2], without.state().positions[2] - 1e-3);
}

TEST_P(TiedFrame, SolversAgree) {
  Simulation direct = run(world_);
  Simulation iterative =
      test::simulate(world_, test::implicit_euler(GetParam(), 1e-12), test::conjugate_gradient(1e-13));
  tie(direct);
  tie(iterative);
  for (int i = 0; i < 50; ++i) {
    direct.step(0.005);
    iterative.step(0.005);
  }
  // 50 steps of the iteration's 1e-13 times the condition of a matrix with a link of 1e5 N/m.
  EXPECT_LT((test::view(direct.state().positions) - test::view(iterative.state().positions)).norm(), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Newton, FrameTest, testing::Values(1, 8),
                         [](const auto& info) { return info.param == 1 ? "once" : "iterated"; });
INSTANTIATE_TEST_SUITE_P(Newton, TiedFrame, testing::Values(1, 8),
                         [](const auto& info) { return info.param == 1 ? "once" : "iterated"; });

}  // namespace
}  // namespace tissu
