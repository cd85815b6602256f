#include "tissu/step/stable_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "methods.h"

/// The stable step of explicit methods: closed forms, and what a body does just below and above it.
namespace tissu {
namespace {

using test::Oscillator;

double limit(const std::string& method, WorldDescription world) {
  Simulation simulation = test::simulate(std::move(world), test::method_named(method).make(), nullptr);
  return simulation.stable_step();
}

// Lanczos stops at 1e-4 of omega^2, and is exact for one degree of freedom; bisection stops at round-off.
constexpr double kFine = 1e-9;

TEST(StableStep, OfTheOscillatorWithoutDamping) {
  const double w = Oscillator::omega();
  EXPECT_NEAR(limit("symplectic_euler", Oscillator::world()) * w, 2.0, 1e-5);
  EXPECT_NEAR(limit("rk4", Oscillator::world()) * w, 2.0 * std::sqrt(2.0), 1e-5);
  // sqrt(1 + h^2 w^2) = e^(h / 100), and sqrt(1 + (h w)^4 / 4) = e^(h / 100)
  const double forward = limit("explicit_euler", Oscillator::world());
  EXPECT_NEAR(0.5 * std::log1p(forward * forward * w * w) / forward, 0.01, 1e-7);  // round-off of 1e-12 in h
  const double second = limit("rk2", Oscillator::world());
  EXPECT_NEAR(0.5 * std::log1p(std::pow(second * w, 4) / 4.0) / second, 0.01, kFine);
}

TEST(StableStep, WithDamping) {
  const double w = Oscillator::omega();
  for (const double c : {0.5, 5.0, 50.0}) {
    WorldDescription world = Oscillator::world();
    world.bodies[0].rayleigh = {c, 0.0};
    // h^2 w^2 + 2 h c = 4
    const double h = (std::sqrt(c * c + 4.0 * w * w) - c) / (w * w);
    EXPECT_NEAR(limit("symplectic_euler", world) / h, 1.0, 1e-5) << c;
  }
  WorldDescription world = Oscillator::world();
  world.bodies[0].rayleigh = {5.0, 0.0};
  // |1 + h lambda|^2 = 1 - h c + h^2 w^2 = e^(h / 50)
  const double h = limit("explicit_euler", world);
  EXPECT_NEAR((1.0 - 5.0 * h + h * h * w * w) / std::exp(0.02 * h), 1.0, kFine);
}

TEST(StableStep, OfImplicitMethodsIsInfinite) {
  EXPECT_EQ(limit("implicit_euler", Oscillator::world()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(limit("fixed_point", Oscillator::world()), std::numeric_limits<double>::infinity());
}

WorldDescription bar() {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {6, 2, 2}, Split::six);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "hooke", .young = 100.0})};
  world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
  return world;
}

/// Largest velocity after many steps of a share of the limit, from a small push.
double speed_after(const std::string& method, double share, int steps) {
  Simulation simulation = test::simulate(bar(), test::method_named(method).make(), nullptr);
  test::Random random(3);
  for (double& v : simulation.state().velocities) v = random.number(1e-6);
  simulation.world().fixed().clear(simulation.state().velocities);
  const double h = share * simulation.stable_step();
  for (int i = 0; i < steps; ++i) simulation.step(h);
  double largest = 0.0;
  for (const double v : simulation.state().velocities) largest = std::max(largest, std::abs(v));
  return largest;
}

TEST(StableStep, IsStableJustBelowForManySteps) {
  // Near the limit the amplitude of the fastest vibration may be 1 / sqrt(1 - share) times larger.
  EXPECT_LT(speed_after("symplectic_euler", 0.999, 20000), 1e-3);
  EXPECT_LT(speed_after("rk4", 0.999, 5000), 1e-5);
}

TEST(StableStep, IsRefusedAbove) {
  for (const char* method : {"explicit_euler", "symplectic_euler", "rk2", "rk4"}) {
    Simulation simulation = test::simulate(bar(), test::method_named(method).make(), nullptr);
    const double h = simulation.stable_step();
    const State before = simulation.state();
    try {
      simulation.step(1.01 * h);
      ADD_FAILURE() << method;
    } catch (const ParameterError& error) {
      EXPECT_NE(std::string(error.what()).find("is stable up to"), std::string::npos) << error.what();
    }
    EXPECT_EQ(simulation.state().positions, before.positions);
    EXPECT_EQ(simulation.state().time, 0.0);
    simulation.step(0.99 * h);
  }
}

/// And it is not refused in vain: twice the limit of symplectic Euler, taken by hand, grows without bound.
TEST(StableStep, IsTheLimit) {
  const double w = Oscillator::omega();
  const auto largest_after = [&](double share) {
    double x = 0.1;
    double v = 0.0;
    const double h = share * limit("symplectic_euler", Oscillator::world());
    for (int i = 0; i < 2000; ++i) {
      v -= h * w * w * x;
      x += h * v;
    }
    return std::abs(x);
  };
  EXPECT_LT(largest_after(0.9999), 100.0);
  EXPECT_GT(largest_after(1.0001), 1e6);
}

TEST(StableStep, FollowsTheDeformation) {
  // StVK stretched by two is stiffer: k = dP/dF grows with F^2.
  WorldDescription world = Oscillator::world("stvk");
  Simulation simulation = test::simulate(world, test::method_named("symplectic_euler").make(), nullptr);
  const double at_rest = simulation.stable_step();
  Oscillator::start(simulation, 0.0, 20.0);
  double limit = at_rest;
  double F = 1.0;
  while (Oscillator::v(simulation) > 0.0) {
    simulation.step(0.02 * at_rest);
    limit = simulation.stable_step();
    F = std::max(F, 1.0 + Oscillator::u(simulation));
  }
  ASSERT_GT(F, 1.5);
  // Measured when the length had last changed by a twentieth, or up to eight steps before.
  const double expected = at_rest / std::sqrt((3.0 * F * F - 1.0) / 2.0);
  EXPECT_GE(limit, 0.999 * expected);
  EXPECT_LE(limit, 1.1 * expected);
}

/// Far below the limit an edge may change by a twentieth. Eight steps of 0.02 / omega, in which a vibration
/// of a tenth of the length goes 1.6 % farther, are between two looks.
TEST(StableStep, IsMeasuredSeldomWhereThereIsRoom) {
  Simulation simulation =
      test::simulate(Oscillator::world("stvk"), test::method_named("symplectic_euler").make(), nullptr);
  const double at_rest = simulation.stable_step();
  Oscillator::start(simulation, 0.0, 0.1 * Oscillator::omega());
  const int steps = 4000;
  double above = 0.0;
  for (int i = 0; i < steps; ++i) {
    simulation.step(0.01 * at_rest);
    const double F = 1.0 + Oscillator::u(simulation);
    const double limit = at_rest / std::sqrt((3.0 * F * F - 1.0) / 2.0);
    above = std::max(above, simulation.stable_step() / limit - 1.0);
  }
  // d ln(omega) / d ln(F) = 3 F^2 / (3 F^2 - 1), 1.7 at F = 0.9
  EXPECT_LT(above, 1.7 * (0.05 + 0.016));
  std::int64_t measured = 0;
  for (const Profile::Row& row : simulation.profile().rows()) {
    if (row.effect == "stable step") measured += row.calls;
  }
  // From 0.9 to 1.1 and back there are eight twentieths, or twenty fiftieths, in each of 80 rad / 2 pi
  // periods.
  const double periods = 0.02 * steps / 6.28;
  EXPECT_GT(measured, 4.0 * periods);
  EXPECT_LT(measured, 10.0 * periods);
}

}  // namespace
}  // namespace tissu
