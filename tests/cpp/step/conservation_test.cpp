#include <gtest/gtest.h>

#include <cmath>

#include "../base/differences.h"
#include "../world/sample_worlds.h"

/// What implicit Euler keeps, and what it may only lose.
namespace tissu {
namespace {

class Conservation : public testing::TestWithParam<Split> {
 protected:
  Mesh mesh_ = test::distorted_box({3, 2, 2}, GetParam(), 0.1);
  test::Random random_{81};

  WorldDescription free_body(const std::string& law, double young = 200.0) const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {.law = law, .young = young})};
    return world;
  }
  static Vec3 momentum(const Simulation& simulation) {
    Vec3 sum = Vec3::Zero();
    const auto& m = simulation.world().mass().nodal();
    for (std::size_t i = 0; i < m.size(); ++i) {
      sum += m[i] * block(ConstReals(simulation.state().velocities), static_cast<std::int32_t>(i));
    }
    return sum;
  }
  /// Fixed nodes back at their places: to lead them there would be work done on the body.
  void hold(Simulation& simulation) const {
    simulation.world().fixed().clear(simulation.state().velocities);
    for (const std::int32_t node : simulation.world().fixed().rows()) {
      block(Reals(simulation.state().positions), node) = mesh_.node(node);
    }
  }
  /// sum m a x b
  static Vec3 moment(const Simulation& simulation, ConstReals a, ConstReals b) {
    Vec3 sum = Vec3::Zero();
    const auto& m = simulation.world().mass().nodal();
    for (std::size_t i = 0; i < m.size(); ++i) {
      const auto node = static_cast<std::int32_t>(i);
      sum += m[i] * block(a, node).cross(Vec3(block(b, node)));
    }
    return sum;
  }
};

// 24 kg at up to 1 m/s; round-off of 1e-16 in each of 36 nodes and 100 steps.
TEST_P(Conservation, LinearMomentumInFreeFlight) {
  for (const char* law : {"hooke", "stvk"}) {
    Simulation simulation = test::simulate(free_body(law), test::implicit_euler(8, 1e-12));
    simulation.state().velocities = random_.numbers(mesh_.positions.size());
    const Vec3 before = momentum(simulation);
    for (int i = 0; i < 100; ++i) simulation.step(0.01);
    EXPECT_LT((momentum(simulation) - before).norm(), 1e-12 * 24.0) << law;
    EXPECT_GT(before.norm(), 0.1);
  }
}

/// Internal forces have no moment, so backward Euler leaves L1 - L0 = h sum m v1 x v0, and nothing else.
TEST_P(Conservation, AngularMomentumDriftsAsTheMethodSays) {
  Simulation simulation = test::simulate(free_body("stvk"), test::implicit_euler(20, 1e-14));
  State& state = simulation.state();
  state.velocities = random_.numbers(mesh_.positions.size(), 0.5);
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    block(Reals(state.velocities), i) += Vec3(0.3, -0.2, 1.0).cross(mesh_.node(i));
  }
  const Vec3 first = moment(simulation, state.positions, state.velocities);
  const double h = 0.01;
  for (int i = 0; i < 50; ++i) {
    const Vec3 before = moment(simulation, state.positions, state.velocities);
    const std::vector<double> v0 = state.velocities;
    ASSERT_TRUE(simulation.step(h).converged);
    const Vec3 drift = moment(simulation, state.positions, state.velocities) - before;
    const Vec3 expected = h * moment(simulation, state.velocities, v0);
    EXPECT_LT((drift - expected).norm(),
              1e-11 * first.norm());  // Newton's 1e-14 of h |f| times arms and nodes
  }
}

/// The drift goes with the step: after the same time, half of it at half the step.
TEST_P(Conservation, AngularMomentumDriftIsOfOrderOne) {
  const auto drift = [&](int steps) {
    Simulation simulation = test::simulate(free_body("stvk"), test::implicit_euler(20, 1e-12));
    State& state = simulation.state();
    for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
      block(Reals(state.velocities), i) = Vec3(0.3, -0.2, 1.0).cross(mesh_.node(i));
    }
    const Vec3 before = moment(simulation, state.positions, state.velocities);
    for (int i = 0; i < steps; ++i) simulation.step(0.1 / steps);
    return (moment(simulation, state.positions, state.velocities) - before).norm() / before.norm();
  };
  const double coarse = drift(20);
  EXPECT_GT(coarse, 1e-6);
  EXPECT_LT(coarse, 0.05);
  EXPECT_NEAR(coarse / drift(40), 2.0, 0.2);
}

/// At a load that does not change, backward Euler only loses energy. Round-off: 1e-12 of the first energy.
TEST_P(Conservation, EnergyDoesNotGrow) {
  for (const char* law : {"hooke", "stvk"}) {
    WorldDescription world = free_body(law);
    world.gravity = Vec3(0.0, 0.0, -2.0);
    world.fixed = {test::fixed({0, 4, 8, 12})};
    Simulation simulation = test::simulate(world, test::implicit_euler(20, 1e-12));
    for (double& x : simulation.state().positions) x += random_.number(0.05);
    simulation.state().velocities = random_.numbers(mesh_.positions.size());
    hold(simulation);
    double before = simulation.energy().total();
    const double kinetic = simulation.energy().kinetic;
    double lost = 0.0;
    for (int i = 0; i < 200; ++i) {
      const StepReport report = simulation.step(0.01);
      ASSERT_TRUE(report.converged) << report.message;
      const double after = simulation.energy().total();
      EXPECT_LE(after, before + 1e-12 * kinetic) << law << ", step " << i;
      lost += before - after;
      before = after;
    }
    EXPECT_GT(lost, 0.1 * kinetic);
  }
}

/// No load, no motion: a thousand steps stay at rest to the round-off of the positions.
TEST_P(Conservation, RestStaysRest) {
  for (const char* law : {"hooke", "stvk"}) {
    for (const int iterations : {1, 5}) {
      Simulation simulation = test::simulate(free_body(law), test::implicit_euler(iterations, 1e-9),
                                             test::conjugate_gradient(1e-6));
      for (int i = 0; i < 1000; ++i) simulation.step(0.01);
      const double drift = (test::view(simulation.state().positions) - test::view(mesh_.positions)).norm();
      EXPECT_LT(drift, 1e-11) << law;
      EXPECT_LT(test::view(simulation.state().velocities).norm(), 1e-11) << law;
    }
  }
}

/// Equilibrium under gravity, found by statics, is where dynamics stays.
TEST_P(Conservation, LoadedRestStaysRest) {
  WorldDescription world = free_body("stvk", 500.0);
  world.gravity = Vec3(0.0, 0.0, -2.0);
  world.fixed = {test::fixed({0, 4, 8, 12})};
  StaticEquilibrium::Settings settings;
  settings.newton = {50, 1e-13};
  Simulation statics = test::simulate(world, std::make_unique<StaticEquilibrium>(settings));
  ASSERT_TRUE(statics.step(1.0).converged);
  Simulation simulation =
      test::simulate(world, test::implicit_euler(5, 1e-9), test::conjugate_gradient(1e-6));
  simulation.state().positions = statics.state().positions;
  for (int i = 0; i < 1000; ++i) simulation.step(0.01);
  const double sag = (test::view(statics.state().positions) - test::view(mesh_.positions)).norm();
  const double drift =
      (test::view(simulation.state().positions) - test::view(statics.state().positions)).norm();
  EXPECT_GT(sag, 0.1);
  EXPECT_LT(drift, 1e-8 * sag);  // the tolerance of Newton's iteration, 1e-9, and the condition of the matrix
}

INSTANTIATE_TEST_SUITE_P(Elements, Conservation, testing::Values(Split::none, Split::six),
                         [](const auto& info) { return info.param == Split::none ? "hexahedron" : "tetra"; });

}  // namespace
}  // namespace tissu
