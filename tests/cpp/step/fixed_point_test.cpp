#include "tissu/step/fixed_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "methods.h"
#include "tissu/step/frequency.h"

/// BDF2 by fixed-point iteration: contraction as predicted, 4/9 (h omega)^2, and what lies beyond it.
namespace tissu {
namespace {

using test::Oscillator;

Simulation oscillating(int iterations) {
  return test::simulate(Oscillator::world(),
                        std::make_unique<Bdf2FixedPoint>(Bdf2FixedPoint::Settings{iterations, 1e-15, 0}),
                        nullptr);
}

/// Residual after n iterations of the second step, BDF2's own, with h omega = y; the first one is solved.
double residual_after(int iterations, double y) {
  Simulation solved = oscillating(500);
  Oscillator::start(solved, 0.1, 0.0);
  solved.step(y / Oscillator::omega());
  Simulation simulation = oscillating(iterations);
  simulation.restore(solved.snapshot());
  return simulation.step(y / Oscillator::omega()).residual;
}

// One degree of freedom: each iteration multiplies the residual by -4/9 y^2 exactly. The first step is one of
// backward Euler, which needs y < 1.
TEST(FixedPoint, ContractsAsPredicted) {
  for (const double y : {0.2, 0.5, 0.9}) {
    // As many as bring what the residual is judged by to its end, and leave a residual above round-off.
    const int n = y < 0.3 ? 4 : 10;
    const double measured = residual_after(n + 1, y) / residual_after(n, y);
    EXPECT_NEAR(measured / (4.0 / 9.0 * y * y), 1.0, 1e-2) << y;
  }
}

WorldDescription bar() {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {6, 2, 2}, Split::six);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 100.0})};
  world.gravity = Vec3(0.0, 0.0, -0.5);
  world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
  return world;
}

Simulation simulate(int anderson) {
  return test::simulate(
      bar(), std::make_unique<Bdf2FixedPoint>(Bdf2FixedPoint::Settings{300, 1e-8, anderson}), nullptr);
}

/// The first step is implicit Euler, whose limit is h omega < 1; the following ones reach 3/2.
TEST(FixedPoint, HoldsBelowItsLimitAndIsRefusedAbove) {
  Simulation simulation = simulate(0);
  const double omega = largest_frequency(simulation.world(), simulation.state());
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(simulation.step(0.9 / omega).converged);
  // r = h / (step before) = 1.3 / 0.9: (1 + r) / (1 + 2 r) 1.3 < 1
  EXPECT_TRUE(simulation.step(1.3 / omega).converged);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(simulation.step(1.4 / omega).converged) << i;
  const State before = simulation.state();
  try {
    for (int i = 0; i < 20; ++i) simulation.step(2.0 / omega);
    ADD_FAILURE() << "two over omega was accepted";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("does not contract"), std::string::npos) << text;
    EXPECT_NE(text.find("9/4"), std::string::npos) << text;
  }
  for (const double x : simulation.state().positions) EXPECT_TRUE(std::isfinite(x));
  EXPECT_GE(simulation.state().time, before.time);
}

TEST(FixedPoint, AndersonGoesBeyondTheLimit) {
  Simulation simulation = simulate(5);
  const double omega = largest_frequency(simulation.world(), simulation.state());
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(simulation.step(4.0 / omega).converged) << i;
}

TEST(FixedPoint, AndersonNeedsFewerIterations) {
  Simulation plain = simulate(0);
  Simulation fast = simulate(5);
  const double h = 0.9 / largest_frequency(plain.world(), plain.state());
  int without = 0;
  int with = 0;
  for (int i = 0; i < 20; ++i) {
    without += plain.step(h).solver_iterations;
    with += fast.step(h).solver_iterations;
  }
  EXPECT_LT(with, without);
}

/// The same equation as BDF2 with Newton's iteration.
TEST(FixedPoint, AgreesWithNewton) {
  Simulation fixed = simulate(5);
  Simulation newton = test::simulate(bar(), std::make_unique<Bdf2>(NewtonSettings{30, 1e-12}));
  const double h = 0.9 / largest_frequency(fixed.world(), fixed.state());
  for (int i = 0; i < 30; ++i) {
    fixed.step(h);
    newton.step(h);
  }
  for (std::size_t i = 0; i < fixed.state().positions.size(); ++i) {
    // Residuals of 1e-8 of the weight in each of thirty steps.
    EXPECT_NEAR(fixed.state().positions[i], newton.state().positions[i], 1e-7);
  }
}

TEST(FixedPoint, RefusesSettings) {
  EXPECT_THROW(Bdf2FixedPoint({0, 1e-6, 0}), ParameterError);
  EXPECT_THROW(Bdf2FixedPoint({10, 0.0, 0}), ParameterError);
  EXPECT_THROW(Bdf2FixedPoint({10, 1e-6, 9}), ParameterError);
}

}  // namespace
}  // namespace tissu
