#include "tissu/contact/barrier.h"

#include <gtest/gtest.h>

#include <cmath>

/// The barrier against its own formula and against differences.

namespace tissu {
namespace {

TEST(Barrier, IsTheFormulaAndEndsWithoutAStep) {
  const double s = 0.3;
  EXPECT_DOUBLE_EQ(barrier_value(s).energy, -(s - 1.0) * (s - 1.0) * std::log(s));
  // Near its end b is (1 - sigma)^3: force and stiffness go to zero there, too.
  for (const double more : {0.0, 1.0}) {
    EXPECT_EQ(barrier_value(1.0 + more).energy, 0.0);
    EXPECT_EQ(barrier_value(1.0 + more).slope, 0.0);
    EXPECT_EQ(barrier_value(1.0 + more).curvature, 0.0);
  }
  const double less = 1e-4;
  EXPECT_NEAR(barrier_value(1.0 - less).energy, less * less * less, 1e-15);
  EXPECT_NEAR(barrier_value(1.0 - less).slope, -3.0 * less * less, 1e-11);
  EXPECT_NEAR(barrier_value(1.0 - less).curvature, 6.0 * less, 1e-7);
}

/// Central differences of step h leave h^2 times a higher derivative: 1e-6 of it, sigma / 1e4 apart.
TEST(Barrier, DerivativesAreThoseOfItsEnergy) {
  for (const double sigma : {2e-5, 9e-5, 2e-4, 0.01, 0.25, 0.7, 0.99}) {
    const double h = 1e-4 * std::min(sigma, 1.0 - sigma);
    const BarrierValue value = barrier_value(sigma);
    const BarrierValue low = barrier_value(sigma - h);
    const BarrierValue high = barrier_value(sigma + h);
    EXPECT_NEAR((high.energy - low.energy) / (2.0 * h), value.slope, 1e-6 * std::abs(value.slope)) << sigma;
    EXPECT_NEAR((high.slope - low.slope) / (2.0 * h), value.curvature, 1e-6 * value.curvature) << sigma;
  }
}

/// The energy and its derivatives are continuous where the quadratic takes over.
TEST(Barrier, GoesOnAsAQuadratic) {
  const double end = 1e-4;
  const BarrierValue above = barrier_value(end);
  const BarrierValue below = barrier_value(std::nextafter(end, 0.0));
  EXPECT_DOUBLE_EQ(above.energy, below.energy);
  EXPECT_DOUBLE_EQ(above.slope, below.slope);
  EXPECT_DOUBLE_EQ(above.curvature, below.curvature);
  EXPECT_GT(barrier_value(-1.0).energy, above.energy);
  EXPECT_TRUE(std::isfinite(barrier_value(-1e6).slope));
}

}  // namespace
}  // namespace tissu
