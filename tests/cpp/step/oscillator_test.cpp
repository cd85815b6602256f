#include <gtest/gtest.h>

#include <cmath>

#include "../world/sample_worlds.h"
#include "tissu/law/law.h"

/// One tetrahedron with one free degree of freedom, beside the recurrences of backward Euler by hand.
namespace tissu {
namespace {

constexpr double kYoung = 50.0;
constexpr double kPoisson = 0.3;
constexpr double kDensity = 2.0;
constexpr double kMass = kDensity / 6.0 / 4.0;  ///< of each node of the unit tetrahedron

/// Node 1 of the unit tetrahedron moves along x: F = diag(1 + u, 1, 1), W = V (lambda + 2 mu) eps^2 / 2.
WorldDescription oscillator(const std::string& law) {
  Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {law, kYoung, kPoisson, kDensity})};
  world.fixed = {test::fixed({0, 2, 3}), test::fixed({1}, 6)};
  return world;
}

double modulus() {
  const Lame c = lame(kYoung, kPoisson);
  return c.lambda + 2.0 * c.mu;
}
double spring() { return modulus() / 6.0; }

struct Scalar {
  double u;
  double v;
};

Scalar now(const Simulation& simulation) {
  return {simulation.state().positions[3] - 1.0, simulation.state().velocities[3]};
}

void start(Simulation& simulation, double u, double v) {
  simulation.state().positions[3] = 1.0 + u;
  simulation.state().velocities[3] = v;
}

class Oscillator : public testing::TestWithParam<bool> {
 protected:
  static std::unique_ptr<LinearSolver> solver() {
    if (GetParam()) return std::make_unique<Cholesky>();
    return test::conjugate_gradient(1e-15);
  }
};

// A hundred steps with round-off of 1e-16 each in numbers of size 1.
TEST_P(Oscillator, FollowsBackwardEuler) {
  Simulation simulation = test::simulate(oscillator("hooke"), test::implicit_euler(), solver());
  const double h = 0.01;
  Scalar s{0.1, -0.5};
  start(simulation, s.u, s.v);
  for (int step = 1; step <= 100; ++step) {
    const StepReport report = simulation.step(h);
    s.v = (kMass * s.v - h * spring() * s.u) / (kMass + h * h * spring());
    s.u += h * s.v;
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(report.time, h * step, 1e-14);
    EXPECT_NEAR(now(simulation).u, s.u, 1e-12) << "step " << step;
    EXPECT_NEAR(now(simulation).v, s.v, 1e-11) << "step " << step;
  }
  EXPECT_EQ(simulation.state().positions[4], 0.0);
  EXPECT_EQ(simulation.state().positions[6], 0.0);
}

TEST_P(Oscillator, FollowsBackwardEulerWithDampingGravityAndLoad) {
  const double alpha = 0.4;
  const double beta = 0.02;
  WorldDescription world = oscillator("hooke");
  world.bodies[0].rayleigh = {alpha, beta};
  world.gravity = Vec3(3.0, 0.0, -1.0);
  world.loads = {{"hand", "body", {1}, {0.5, 0.0, 0.0}, {{0.0, 0.5, 1.0}, {0.0, 1.0, 0.0}}}};
  Simulation simulation = test::simulate(world, test::implicit_euler(), solver());
  const double h = 0.01;
  const double k = spring();
  Scalar s{0.1, -0.5};
  start(simulation, s.u, s.v);
  for (int step = 1; step <= 100; ++step) {
    simulation.step(h);
    const double t = h * step;  // loads act with their value at the end of the step
    const double load = 0.5 * (t <= 0.5 ? t / 0.5 : (1.0 - t) / 0.5) + kMass * 3.0;
    s.v = (kMass * s.v + h * (load - k * s.u)) / (kMass + h * alpha * kMass + h * beta * k + h * h * k);
    s.u += h * s.v;
    EXPECT_NEAR(now(simulation).u, s.u, 1e-12) << "step " << step;
    EXPECT_NEAR(now(simulation).v, s.v, 1e-11) << "step " << step;
  }
}

/// The base is led: the spring and the damper feel where it is, and how fast, at the end of the step.
TEST_P(Oscillator, FollowsALedBase) {
  const double alpha = 0.4;
  const double beta = 0.02;
  WorldDescription world = oscillator("hooke");
  world.bodies[0].rayleigh = {alpha, beta};
  world.fixed[0].motion.times = {0.1, 0.3, 0.4};
  world.fixed[0].motion.displacements = {Vec3::Zero(), Vec3(0.2, 0, 0), Vec3(0.1, 0, 0)};
  world.fixed[0].motion.angles = {0.0, 0.0, 0.0};
  Simulation simulation = test::simulate(world, test::implicit_euler(), solver());
  const double h = 0.01;
  const double k = spring();
  Scalar s{0.0, 0.0};
  double base = 0.0;
  for (int step = 1; step <= 60; ++step) {
    simulation.step(h);
    const double to = interpolate(std::vector{0.1, 0.3, 0.4}, std::vector{0.0, 0.2, 0.1}, h * step, 0.0);
    const double base_v = (to - base) / h;
    s.v = (kMass * s.v - h * k * (s.u - to) + h * beta * k * base_v) /
          (kMass + h * alpha * kMass + h * beta * k + h * h * k);
    s.u += h * s.v;
    base = to;
    EXPECT_NEAR(now(simulation).u, s.u, 1e-12) << "step " << step;
    EXPECT_NEAR(now(simulation).v, s.v, 1e-11) << "step " << step;
  }
  EXPECT_GT(s.u, 0.05);
}

/// StVK, held aside: f = -V (lambda + 2 mu) / 2 (F^3 - F).
TEST_P(Oscillator, FollowsBackwardEulerOfStVKByNewton) {
  Simulation simulation = test::simulate(oscillator("stvk"), test::implicit_euler(30, 1e-13), solver());
  const double h = 0.02;
  Scalar s{0.3, 2.0};
  start(simulation, s.u, s.v);
  for (int step = 1; step <= 50; ++step) {
    const StepReport report = simulation.step(h);
    EXPECT_TRUE(report.converged) << report.message;
    double v = s.v;
    for (int i = 0; i < 50; ++i) {  // Newton by hand, to round-off
      const double F = 1.0 + s.u + h * v;
      const double residual = kMass * (v - s.v) + h * spring() * 0.5 * (F * F * F - F);
      v -= residual / (kMass + h * h * spring() * 0.5 * (3.0 * F * F - 1.0));
    }
    s = {s.u + h * v, v};
    EXPECT_NEAR(now(simulation).u, s.u, 1e-10) << "step " << step;  // 50 steps of 1e-13
    EXPECT_NEAR(now(simulation).v, s.v, 1e-9) << "step " << step;
  }
}

/// One Newton step of StVK from x0 + h v0 is the linearised step: M dv = h (f0 + h K v0) + h^2 K dv.
TEST_P(Oscillator, LinearisedOnceIsOneTangent) {
  Simulation simulation = test::simulate(oscillator("stvk"), test::implicit_euler(), solver());
  const double h = 0.02;
  Scalar s{0.3, 2.0};
  start(simulation, s.u, s.v);
  simulation.step(h);
  const double F = 1.3;
  const double K = spring() * 0.5 * (3.0 * F * F - 1.0);
  const double f = -spring() * 0.5 * (F * F * F - F);
  const double v = (kMass * s.v + h * f) / (kMass + h * h * K);
  EXPECT_NEAR(now(simulation).v, v, 1e-13);
}

// The error after one second halves with the step: order 1, to the second-order term of some percent.
TEST_P(Oscillator, ConvergesWithOrderOne) {
  const double omega = std::sqrt(spring() / kMass);
  const double T = 0.2;
  const auto error = [&](int steps) {
    Simulation simulation = test::simulate(oscillator("hooke"), test::implicit_euler(), solver());
    start(simulation, 0.1, 0.0);
    for (int i = 0; i < steps; ++i) simulation.step(T / steps);
    return std::abs(now(simulation).u - 0.1 * std::cos(omega * T));
  };
  const double order = std::log2(error(2000) / error(4000));
  EXPECT_NEAR(order, 1.0, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Oscillator, testing::Bool(),
                         [](const auto& info) { return info.param ? "cholesky" : "conjugate_gradient"; });

TEST(ImplicitEuler, RefusesSettingsWithoutSense) {
  EXPECT_THROW(ImplicitEuler({0, 1e-6}), ParameterError);
  EXPECT_THROW(ImplicitEuler({3, 0.0}), ParameterError);
  EXPECT_THROW(ImplicitEuler({3, std::nan("")}), ParameterError);
}

}  // namespace
}  // namespace tissu
