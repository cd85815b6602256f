#include "tissu/step/energy_momentum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../world/sample_worlds.h"
#include "tissu/step/implicit_midpoint.h"
#include "tissu/step/newmark.h"

namespace tissu {
namespace {

Vec3 momentum(const Simulation& simulation) {
  Vec3 sum = Vec3::Zero();
  const std::vector<double>& mass = simulation.world().mass().nodal();
  for (std::int32_t i = 0; i < simulation.state().blocks(); ++i) {
    sum += mass[static_cast<std::size_t>(i)] * block(ConstReals(simulation.state().velocities), i);
  }
  return sum;
}

Vec3 angular_momentum(const Simulation& simulation) {
  Vec3 sum = Vec3::Zero();
  const std::vector<double>& mass = simulation.world().mass().nodal();
  for (std::int32_t i = 0; i < simulation.state().blocks(); ++i) {
    const Vec3 x = block(ConstReals(simulation.state().positions), i);
    sum += mass[static_cast<std::size_t>(i)] * x.cross(block(ConstReals(simulation.state().velocities), i));
  }
  return sum;
}

/// A bar of 0.1 x 0.02 x 0.02 m, one half held, the other thrown against it.
Simulation thrown(std::unique_ptr<Integrator> integrator) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(0.1, 0.02, 0.02), {10, 2, 2}, Split::none);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 1e6, .poisson = 0.3, .density = 1000.0})};
  world.fixed = {test::fixed(test::nodes_where(mesh, [](const Vec3& x) { return x.x() < 0.05 - 1e-9; }))};
  Simulation simulation =
      test::simulate(std::move(world), std::move(integrator), std::make_unique<Cholesky>());
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    if (mesh.node(i).x() > 0.05 - 1e-9) block(Reals(simulation.state().velocities), i).x() = -500.0;
  }
  return simulation;
}

// 500 m/s into a held half: the bar turns inside out, and its energy is what it was. Each step is solved to
// 1e-9 of what acts, whose work is of the size of the energy: 1e-6 over a hundred of them.
TEST(EnergyMomentum, KeepsTheEnergyOfAThrownBar) {
  Simulation simulation = thrown(std::make_unique<EnergyMomentum>());
  const double before = simulation.energy().total();
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(simulation.step(1e-4).converged);
    ASSERT_NEAR(simulation.energy().total() / before, 1.0, 1e-6) << i;
  }
}

Simulation tumbling(const std::string& law, std::unique_ptr<Integrator> integrator) {
  const Mesh mesh = test::distorted_box({3, 2, 2}, Split::none, 0.1);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = law, .young = 100.0, .poisson = 0.3, .density = 1.0})};
  Simulation simulation =
      test::simulate(std::move(world), std::move(integrator), std::make_unique<Cholesky>());
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    const Vec3 x = mesh.node(i);
    const Vec3 v =
        Vec3(1.0, -0.5, 0.3) + Vec3(0.4, 2.0, -1.0).cross(x) + Vec3(2.0 * x.x(), -x.y(), 0.5 * x.x());
    block(Reals(simulation.state().velocities), i) = v;
  }
  return simulation;
}

// The same bar by methods that keep the energy of linear bodies only: it grows, and that is said before it is
// a hundred times what it was.
void expect_growth_is_said(std::unique_ptr<Integrator> method) {
  Simulation simulation = thrown(std::move(method));
  const double before = simulation.energy().total();
  std::string said;
  try {
    for (int i = 0; i < 100; ++i) {
      const StepReport report = simulation.step(1e-4);
      const double growth = simulation.energy().total() / before - 1.0;
      if (growth > EnergyWatch::kReported) {
        EXPECT_FALSE(report.converged) << growth;
        said = report.message;
      }
      EXPECT_LE(growth, EnergyWatch::kRefused * 1.01);
    }
  } catch (const Diverged& error) {
    said = error.what();
  }
  EXPECT_NE(said.find("take energy_momentum"), std::string::npos) << said;
  EXPECT_LE(simulation.energy().total() / before - 1.0, EnergyWatch::kRefused * 1.01);
}

TEST(EnergyWatch, SaysThatTheMidpointRuleGains) {
  expect_growth_is_said(std::make_unique<ImplicitMidpoint>(NewtonSettings{40, 1e-9}));
}
TEST(EnergyWatch, SaysThatNewmarksMethodGains) {
  expect_growth_is_said(std::make_unique<Newmark>(Newmark::Settings{0.25, 0.5, {40, 1e-9}}));
}

/// What a step says, of either kind.
std::string said_by(Simulation& simulation) {
  try {
    return simulation.step(1e-4).message;
  } catch (const Diverged& error) {
    return error.what();
  }
}

// A growth that began before the snapshot counts after it: the same words with the same numbers.
TEST(EnergyWatch, GoesOnFromASnapshot) {
  const auto newmark = [] { return std::make_unique<Newmark>(Newmark::Settings{0.25, 0.5, {40, 1e-9}}); };
  Simulation simulation = thrown(newmark());
  const double before = simulation.energy().total();
  while (simulation.energy().total() < 1.05 * before) simulation.step(1e-4);
  Simulation other = thrown(newmark());
  other.restore(simulation.snapshot());
  std::string said;
  for (int i = 0; i < 50 && said.empty(); ++i) {
    said = said_by(simulation);
    EXPECT_EQ(said_by(other), said) << i;
  }
  EXPECT_NE(said.find("the energy has grown by"), std::string::npos) << said;
  EXPECT_EQ(other.snapshot().energy_watch, simulation.snapshot().energy_watch);
}

TEST(EnergyWatch, ForgetsARefusedStep) {
  Simulation simulation = thrown(std::make_unique<Newmark>(Newmark::Settings{0.25, 0.5, {40, 1e-9}}));
  std::vector<double> before;
  bool refused = false;
  for (int i = 0; i < 5000 && !refused; ++i) {
    before = simulation.snapshot().energy_watch;
    try {
      simulation.step(1e-4);
    } catch (const Diverged&) {
      refused = true;
    }
  }
  ASSERT_TRUE(refused);
  const std::vector<double> after = simulation.snapshot().energy_watch;
  EXPECT_EQ(after[1], before[1]);  // gained so far
  EXPECT_EQ(after[2], before[2]);  // the largest energy before
}

TEST(EnergyWatch, IsSilentWhereEnergyIsKept) {
  Simulation simulation = tumbling("stvk", std::make_unique<EnergyMomentum>());
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(simulation.step(0.02).message.empty());
}

// What is written between two steps is no gain.
TEST(EnergyWatch, DoesNotCountWhatIsWritten) {
  Simulation simulation = tumbling("stvk", std::make_unique<EnergyMomentum>());
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(simulation.step(0.005).message.empty());
    for (double& v : simulation.state().velocities) v *= 1.5;
  }
}

class Laws : public testing::TestWithParam<const char*> {};

// Free flight with large strains: Newton's tolerance of 1e-9, over 200 steps.
TEST_P(Laws, KeepsEnergyAndMomentaInFreeFlight) {
  Simulation simulation = tumbling(GetParam(), std::make_unique<EnergyMomentum>());
  const double energy = simulation.energy().total();
  const Vec3 linear = momentum(simulation);
  const Vec3 angular = angular_momentum(simulation);
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(simulation.step(0.02).converged) << i;
  EXPECT_NEAR(simulation.energy().total() / energy, 1.0, 1e-7);
  EXPECT_LT((momentum(simulation) - linear).norm(), 1e-7 * linear.norm());
  EXPECT_LT((angular_momentum(simulation) - angular).norm(), 1e-7 * angular.norm());
}

INSTANTIATE_TEST_SUITE_P(EnergyMomentum, Laws, testing::Values("stvk", "neo_hooke", "stable_neo_hooke"));

// Links stand in the state: the energy that they store is kept as well.
TEST(EnergyMomentum, KeepsTheEnergyOfLinks) {
  const Mesh mesh = test::distorted_box({3, 2, 2}, Split::none, 0.1);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 100.0, .poisson = 0.3, .density = 1.0})};
  world.links = true;
  Simulation simulation =
      test::simulate(std::move(world), std::make_unique<EnergyMomentum>(), std::make_unique<Cholesky>());
  test::links(simulation).add({0}, {mesh.node_count() - 1}, 5.0);
  const double energy = simulation.energy().total();
  EXPECT_GT(energy, 1.0);  // 5 N/m over more than 1 m
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(simulation.step(0.02).converged) << i;
  EXPECT_GT(simulation.energy().kinetic, 1e-3 * energy);
  EXPECT_NEAR(simulation.energy().total() / energy, 1.0, 1e-7);
}

// Two bodies, each with its own correction, and links soft and stiff between them, which need none.
TEST(EnergyMomentum, KeepsTheEnergyOfLinkedBodies) {
  const Mesh mesh = test::distorted_box({3, 2, 2}, Split::none, 0.1);
  Mesh beside = mesh;
  for (std::size_t i = 0; i < beside.positions.size(); i += 3) beside.positions[i] += 1.5;
  for (const double stiffness : {5.0, 5000.0}) {
    WorldDescription world;
    const test::Material material{.law = "stvk", .young = 100.0, .poisson = 0.3, .density = 1.0};
    world.bodies = {test::body_of(mesh, material, "one"), test::body_of(beside, material, "other")};
    world.links = true;
    Simulation simulation =
        test::simulate(std::move(world), std::make_unique<EnergyMomentum>(), std::make_unique<Cholesky>());
    test::links(simulation).add({0}, {2 * mesh.node_count() - 1}, stiffness);
    for (std::int32_t i = 0; i < mesh.node_count(); ++i)
      block(Reals(simulation.state().velocities), i).x() = 0.5 * mesh.node(i).y();
    const double energy = simulation.energy().total();
    const Vec3 linear = momentum(simulation);
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(simulation.step(0.005).converged) << i;
    EXPECT_GT(simulation.energy().kinetic, 1e-3 * energy);
    EXPECT_NEAR(simulation.energy().total() / energy, 1.0, 1e-7) << stiffness;
    const double size = std::sqrt(2.0 * energy * simulation.world().mass().total());
    EXPECT_LT((momentum(simulation) - linear).norm(), 1e-7 * size) << stiffness;
  }
}

double error_of(double h) {
  const auto positions = [](std::unique_ptr<Integrator> integrator, double step) {
    Simulation simulation = tumbling("stvk", std::move(integrator));
    for (int i = 0; i < static_cast<int>(std::lround(0.2 / step)); ++i) simulation.step(step);
    return simulation.state().positions;
  };
  const std::vector<double> exact = positions(std::make_unique<EnergyMomentum>(), 0.2 / 1024);
  const std::vector<double> found = positions(std::make_unique<EnergyMomentum>(), h);
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) worst = std::max(worst, std::abs(found[i] - exact[i]));
  return worst;
}

TEST(EnergyMomentum, IsOfSecondOrder) {
  const double ratio = error_of(0.2 / 32) / error_of(0.2 / 64);
  EXPECT_NEAR(std::log2(ratio), 2.0, 0.1) << ratio;
}

}  // namespace
}  // namespace tissu
