#include "methods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "../base/differences.h"

/// What every method must do: lead nodes, keep momenta, go on from its memory, give the same bits.
namespace tissu {
namespace {

using test::Method;

class Methods : public testing::TestWithParam<Method> {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {3, 1, 1}, Split::six);

  WorldDescription bar(int threads = 1) const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {.law = "stvk", .young = 60.0})};
    world.threads = threads;
    return world;
  }
  Simulation simulate(WorldDescription world) const {
    return test::simulate(std::move(world), GetParam().make());
  }
};

/// Below every limit here.
double step_of(const Method& method) { return 2e-3 / test::finer(method); }

TEST_P(Methods, LeadNodesWhereTheyAreToBe) {
  WorldDescription world = bar();
  const std::vector<std::int32_t> tip = test::nodes_at(mesh_, 0, 3.0);
  Motion motion;
  motion.times = {0.0, 0.05, 0.2};
  motion.displacements = {Vec3::Zero(), Vec3(0.1, 0.05, 0.0), Vec3(-0.1, 0.1, 0.0)};
  motion.angles = {0.0, 0.2, -0.3};
  motion.center = Vec3(3.0, 0.5, 0.5);
  world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0)), test::fixed(tip)};
  world.fixed[1].motion = motion;
  Simulation simulation = simulate(world);
  for (int i = 0; i < 60 * test::finer(GetParam()); ++i) {
    simulation.step(step_of(GetParam()));
    for (const std::int32_t node : tip) {
      const Vec3 to = motion.position(mesh_.node(node), simulation.state().time);
      EXPECT_LT((block(ConstReals(simulation.state().positions), node) - to).norm(), 1e-14);
    }
  }
}

/// A free body that spins and flies: forces between its nodes keep linear momentum to round-off in every
/// method; angular momentum to the order of the method, exactly with the midpoint rule.
TEST_P(Methods, KeepMomentum) {
  WorldDescription world = bar();
  Simulation simulation = simulate(world);
  for (std::int32_t node = 0; node < mesh_.node_count(); ++node) {
    block(Reals(simulation.state().velocities), node) =
        Vec3(0.3, -0.2, 0.5) + Vec3(0.2, 0.4, -0.3).cross(mesh_.node(node));
  }
  const auto momentum = [&] {
    std::vector<double> each(simulation.state().velocities.size(), 0.0);
    simulation.world().mass().add_product(simulation.state(), 1.0, simulation.state().velocities, each);
    Vec3 linear = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
    for (std::int32_t node = 0; node < mesh_.node_count(); ++node) {
      const Vec3 p = block(ConstReals(each), node);
      linear += p;
      angular += block(ConstReals(simulation.state().positions), node).cross(p);
    }
    return std::pair(linear, angular);
  };
  const auto [linear, angular] = momentum();
  for (int i = 0; i < 100 * test::finer(GetParam()); ++i) simulation.step(step_of(GetParam()));
  const auto [linear_after, angular_after] = momentum();
  EXPECT_LT((linear_after - linear).norm(), 1e-11 * linear.norm());
  // Newton stops at 1e-13 of the residual: the moments of what is left.
  const double drift = (angular_after - angular).norm() / angular.norm();
  EXPECT_LT(drift, GetParam().name == "implicit_midpoint" ? 1e-10 : GetParam().order == 1 ? 2e-2 : 1e-4);
}

TEST_P(Methods, GoOnFromTheirMemoryBitForBit) {
  WorldDescription world = bar();
  world.gravity = Vec3(0.0, 0.0, -1.0);
  world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
  const auto shared = std::make_shared<const World>(world);
  Profile profile;
  const auto begin = [&](LinearSolver& solver) {
    std::unique_ptr<Integrator> method = GetParam().make();
    method->prepare(*shared, &solver, profile);
    return method;
  };
  Cholesky solver;
  State straight = shared->rest_state();
  const std::unique_ptr<Integrator> one = begin(solver);
  for (int i = 0; i < 25; ++i) one->step(straight, i == 7 ? 0.5 * step_of(GetParam()) : step_of(GetParam()));
  State stopped = straight;
  const std::vector<double> memory = one->memory();
  for (int i = 0; i < 25; ++i) one->step(straight, step_of(GetParam()));

  Cholesky other;
  const std::unique_ptr<Integrator> two = begin(other);
  two->restore(memory);
  for (int i = 0; i < 25; ++i) two->step(stopped, step_of(GetParam()));
  EXPECT_EQ(std::memcmp(straight.positions.data(), stopped.positions.data(),
                        straight.positions.size() * sizeof(double)),
            0);
  EXPECT_EQ(std::memcmp(straight.velocities.data(), stopped.velocities.data(),
                        straight.velocities.size() * sizeof(double)),
            0);
}

/// Bodies that are put elsewhere between two steps go on from there.
TEST_P(Methods, ForgetWhatBelongsToAnotherState) {
  WorldDescription world = bar();
  world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
  Simulation moved = simulate(world);
  for (std::int32_t node = 0; node < mesh_.node_count(); ++node) {
    block(Reals(moved.state().velocities), node) = Vec3(0.0, 0.0, mesh_.node(node).x());
  }
  for (int i = 0; i < 5; ++i) moved.step(step_of(GetParam()));
  moved.state().positions = moved.world().rest_positions();
  std::ranges::fill(moved.state().velocities, 0.0);
  for (int i = 0; i < 5; ++i) moved.step(step_of(GetParam()));
  for (std::size_t i = 0; i < moved.state().positions.size(); ++i) {
    EXPECT_NEAR(moved.state().positions[i], moved.world().rest_positions()[i], 1e-13);
  }
}

TEST_P(Methods, GiveTheSameBitsOnAnyNumberOfThreads) {
  const auto run = [&](int threads) {
    WorldDescription world = bar(threads);
    world.gravity = Vec3(0.0, 0.0, -1.0);
    world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
    Simulation simulation = simulate(world);
    for (int i = 0; i < 20; ++i) simulation.step(step_of(GetParam()));
    return simulation.state().positions;
  };
  const std::vector<double> one = run(1);
  for (const int threads : {2, 3}) {
    const std::vector<double> several = run(threads);
    EXPECT_EQ(std::memcmp(one.data(), several.data(), one.size() * sizeof(double)), 0) << threads;
  }
}

/// A load that changes in time is taken where the method says, so that its impulse is right to first order.
TEST_P(Methods, TakeLoadsInTime) {
  WorldDescription world = bar();
  // 1 N on the whole for a tenth of a second, then nothing.
  std::vector<std::int32_t> all(static_cast<std::size_t>(mesh_.node_count()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
  std::vector<double> forces;
  for (const std::int32_t node : all) {
    (void)node;
    forces.insert(forces.end(), {0.0, 1.0 / mesh_.node_count(), 0.0});
  }
  world.loads = {{"push", "body", all, forces, {{0.0, 0.1, 0.100001}, {1.0, 1.0, 0.0}}}};
  Simulation simulation = simulate(world);
  for (int i = 0; i < 100 * test::finer(GetParam()); ++i) simulation.step(step_of(GetParam()));
  std::vector<double> each(simulation.state().velocities.size(), 0.0);
  simulation.world().mass().add_product(simulation.state(), 1.0, simulation.state().velocities, each);
  double impulse = 0.0;
  for (std::size_t i = 1; i < each.size(); i += 3) impulse += each[i];
  EXPECT_NEAR(impulse, 0.1, 1.01 * step_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(All, Methods, testing::ValuesIn(test::all_methods()),
                         testing::PrintToStringParamName());

TEST(Newmark, RefusesUnstableParameters) {
  EXPECT_THROW(Newmark({0.2, 0.5, {}}), ParameterError);
  EXPECT_THROW(Newmark({0.25, 0.4, {}}), ParameterError);
  EXPECT_THROW(Newmark({0.6, 0.5, {}}), ParameterError);
}

TEST(RungeKutta, RefusesOtherOrders) { EXPECT_THROW(RungeKutta(3), ParameterError); }

TEST(ImplicitMethods, NeedASolver) {
  Simulation simulation = test::simulate(test::Oscillator::world(), test::implicit_euler(), nullptr);
  EXPECT_THROW(simulation.step(0.1), ParameterError);
}

}  // namespace
}  // namespace tissu
