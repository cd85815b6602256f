#include <gtest/gtest.h>

#include <numbers>

#include "../base/differences.h"
#include "../world/sample_worlds.h"

/// Led nodes arrive where they are to be, whatever the body, the solver or the iteration do.
namespace tissu {
namespace {

struct PrescribedCase {
  const char* law;
  int newton;
  bool direct;
};

void PrintTo(const PrescribedCase& c, std::ostream* out) {
  *out << c.law << (c.newton > 1 ? "_newton_" : "_once_") << (c.direct ? "cholesky" : "conjugate_gradient");
}

class Prescribed : public testing::TestWithParam<PrescribedCase> {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {6, 2, 2}, Split::six);
  std::vector<std::int32_t> tip_ = test::nodes_at(mesh_, 0, 3.0);

  /// Held at x = 0, led at x = 3.
  WorldDescription bar(const Motion& motion, std::uint8_t axes = FixedDofs::kAllAxes) const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {.law = GetParam().law, .young = 200.0})};
    world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0)), test::fixed(tip_, axes)};
    world.fixed[1].motion = motion;
    return world;
  }
  static Simulation run(WorldDescription world) {
    auto solver = GetParam().direct ? std::make_unique<Cholesky>() : test::conjugate_gradient(1e-8);
    return test::simulate(std::move(world), test::implicit_euler(GetParam().newton, 1e-8), std::move(solver));
  }
  /// Largest distance of a led component from its place, and of a held node from its own.
  double gap(const Simulation& simulation, const Motion& motion,
             std::uint8_t axes = FixedDofs::kAllAxes) const {
    double worst = 0.0;
    const State& state = simulation.state();
    for (const std::int32_t node : tip_) {
      const Vec3 to =
          motion.position(mesh_.node(node), state.time) - block(ConstReals(state.positions), node);
      for (int axis = 0; axis < 3; ++axis) {
        if (((axes >> axis) & 1) != 0) worst = std::max(worst, std::abs(to[axis]));
      }
    }
    for (const std::int32_t node : test::nodes_at(mesh_, 0, 0.0)) {
      worst = std::max(worst, (mesh_.node(node) - block(ConstReals(state.positions), node)).norm());
    }
    return worst;
  }
};

// x0 + h (x1 - x0) / h: two roundings of a number below 4.
constexpr double kRoundOff = 2e-15;

TEST_P(Prescribed, TurnsByHalfATurn) {
  Motion motion;
  motion.times = {0.1, 0.5};
  motion.displacements = {Vec3::Zero(), Vec3(0.5, 0.0, 0.0)};
  motion.angles = {0.0, std::numbers::pi};
  motion.center = Vec3(0.0, 0.5, 0.5);
  Simulation simulation = run(bar(motion));
  for (int i = 0; i < 60; ++i) {
    simulation.step(0.01);
    ASSERT_LT(gap(simulation, motion), kRoundOff) << "step " << i;
  }
  // Held after its last time: it has come to rest there.
  for (const std::int32_t node : tip_) {
    EXPECT_LT(block(ConstReals(simulation.state().velocities), node).norm(), 1e-12);
  }
}

TEST_P(Prescribed, LeadsSomeAxesOnly) {
  Motion motion;
  motion.times = {0.0, 1.0};
  motion.displacements = {Vec3::Zero(), Vec3(1.0, 0.7, 0.0)};
  motion.angles = {0.0, 0.0};
  Simulation simulation = run(bar(motion, 3));
  simulation.state().velocities[static_cast<std::size_t>(3 * tip_[0] + 2)] = 1.0;
  for (int i = 0; i < 20; ++i) simulation.step(0.01);
  EXPECT_LT(gap(simulation, motion, 3), kRoundOff);
  EXPECT_GT(std::abs(simulation.state().positions[static_cast<std::size_t>(3 * tip_[0] + 2)]), 1e-4);
}

/// Compressed to less than half within two steps: the tangent of StVK is far from definite there.
TEST_P(Prescribed, ArrivesThroughCompression) {
  Motion motion;
  motion.times = {0.0, 1.0};
  motion.displacements = {Vec3::Zero(), Vec3(-1.7, 0.0, 0.0)};
  motion.angles = {0.0, 0.0};
  Simulation simulation = run(bar(motion));
  for (int i = 0; i < 4; ++i) {
    try {
      simulation.step(0.5);
    } catch (const Diverged&) {
      return;  // said so, and rolled back: nothing is claimed
    }
    ASSERT_LT(gap(simulation, motion), kRoundOff) << "step " << i;
  }
}

/// A body that is led as a whole, in a rigid motion, feels no force (StVK).
TEST_P(Prescribed, RigidMotionOfAllNodes) {
  Motion motion;
  motion.times = {0.0, 1.0};
  motion.displacements = {Vec3::Zero(), Vec3(1, 2, 3)};
  motion.angles = {0.0, 3.0};
  WorldDescription world = bar({});
  world.fixed.resize(1);
  world.fixed[0] = test::fixed(test::nodes_where(mesh_, [](const Vec3&) { return true; }));
  world.fixed[0].motion = motion;
  Simulation simulation = run(world);
  for (int i = 0; i < 10; ++i) simulation.step(0.1);
  if (std::string(GetParam().law) == "stvk") {
    EXPECT_LT(simulation.energy().elastic, 1e-20);  // strains of 1e-15: 200 Pa x 3 m3 x 1e-30, with a margin
  }
  EXPECT_NEAR(simulation.state().time, 1.0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Ways, Prescribed,
                         testing::Values(PrescribedCase{"hooke", 1, true}, PrescribedCase{"hooke", 1, false},
                                         PrescribedCase{"stvk", 1, true}, PrescribedCase{"stvk", 1, false},
                                         PrescribedCase{"stvk", 8, true}, PrescribedCase{"stvk", 8, false}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace tissu
