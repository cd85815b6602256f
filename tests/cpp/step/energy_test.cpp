#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "methods.h"

/// What every method does to the energy of the linear oscillator, beside the factor that its recurrence
/// gives.
namespace tissu {
namespace {

using test::Method;
using test::Oscillator;

/// Energy after `steps` steps with h omega = y, over that at the start.
double energy_ratio(const std::string& method, double y, int steps) {
  const double h = y / Oscillator::omega();
  Simulation simulation = test::simulate(Oscillator::world(), test::method_named(method).make());
  Oscillator::start(simulation, 0.1, 0.0);
  const double before = simulation.energy().total();
  for (int i = 0; i < steps; ++i) simulation.step(h);
  return simulation.energy().total() / before;
}

constexpr double kSteps = 200;
// Every step rounds numbers of size 1 in units of 1e-16, the energy twice that.
constexpr double kRoundOff = 1e-11;

TEST(Energy, IsKeptByTheMidpointRuleAndByNewmark) {
  for (const double y : {0.1, 1.0, 10.0}) {
    EXPECT_NEAR(energy_ratio("implicit_midpoint", y, kSteps), 1.0, kRoundOff) << y;
    EXPECT_NEAR(energy_ratio("newmark", y, kSteps), 1.0, kRoundOff) << y;
  }
}

TEST(Energy, FallsByAKnownFactorWithImplicitEuler) {
  for (const double y : {0.01, 0.1, 1.0}) {
    EXPECT_NEAR(energy_ratio("implicit_euler", y, 20) * std::pow(1.0 + y * y, 20), 1.0, 1e-10) << y;
  }
}

TEST(Energy, GrowsByAKnownFactorWithExplicitEulerAndRungeKutta) {
  // Within their limits: a growth by e takes more than a hundred seconds, y omega / 2 and y^3 omega / 8 <
  // 0.01.
  const double small = 1e-3;
  EXPECT_NEAR(energy_ratio("explicit_euler", small, 1000) / std::pow(1.0 + small * small, 1000), 1.0,
              kRoundOff);
  const double middle = 0.15;
  EXPECT_NEAR(energy_ratio("rk2", middle, 100) / std::pow(1.0 + std::pow(middle, 4) / 4.0, 100), 1.0,
              kRoundOff);
  const double y = 0.5;
  const double four = 1.0 - std::pow(y, 6) / 72.0 + std::pow(y, 8) / 576.0;
  EXPECT_NEAR(energy_ratio("rk4", y, 100) / std::pow(four, 100), 1.0, kRoundOff);
}

/// Symplectic Euler keeps x^2 + (v / omega)^2 - y x v / omega of one step exactly.
TEST(Energy, OfSymplecticEulerDoesNotDrift) {
  for (const double y : {0.1, 1.0, 1.99}) {
    const double w = Oscillator::omega();
    Simulation simulation =
        test::simulate(Oscillator::world(), test::method_named("symplectic_euler").make());
    Oscillator::start(simulation, 0.1, 0.0);
    const auto kept = [&] {
      const double x = Oscillator::u(simulation);
      const double v = Oscillator::v(simulation) / w;
      return x * x + v * v - y * x * v;
    };
    const double before = kept();
    for (int i = 0; i < 10000; ++i) simulation.step(y / w);
    EXPECT_NEAR(kept() / before, 1.0, 1e-9) << y;
  }
}

/// The larger root of (3/2 + i y)^... : BDF2 on x' = i omega x has 3 r^2 - 4 r + 1 = 2 i y r^2.
TEST(Energy, FallsWithBdf2ByTheRootOfItsPolynomial) {
  const double y = 0.3;
  const std::complex<double> a(3.0, -2.0 * y);
  const std::complex<double> root = std::sqrt(4.0 - a);
  const double factor = std::max(std::abs((2.0 + root) / a), std::abs((2.0 - root) / a));
  // After the first steps only the larger root is left.
  const double ratio = energy_ratio("bdf2", y, 140) / energy_ratio("bdf2", y, 40);
  EXPECT_NEAR(ratio / std::pow(factor, 200), 1.0, 1e-9);
  EXPECT_LT(factor, 1.0);
}

TEST(Energy, OfDampedNewmarkFallsFastForFastVibrations) {
  // The spectral radius at infinity of beta = 0.36, gamma = 0.7: from 1/2 - ... of the 2x2 step matrix.
  const double fast = energy_ratio("newmark_damped", 100.0, 50);
  const double slow = energy_ratio("newmark_damped", 0.01, 50);
  EXPECT_LT(fast, 1e-3);
  EXPECT_GT(slow, 0.99);
}

}  // namespace
}  // namespace tissu
