#include "tissu/contact/penalty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// The damper of a restitution, against the motion that it is meant for.

namespace tissu {
namespace {

/// x'' = min(0, -x - 2 zeta x') from x = 0 with the speed 1, until the force ends: the speed there.
/// Symplectic Euler, whose error is that of its step.
double given_back(double zeta, double h) {
  double x = 0.0;
  double v = 1.0;
  do {
    v += h * std::min(0.0, -x - 2.0 * zeta * v);
    x += h * v;
  } while (x > 0.0);
  return -v;
}

TEST(Penalty, ADamperGivesBackTheRestitution) {
  for (const double e : {0.14, 0.3, 0.5, 0.7, 0.9, 1.0}) {
    const double zeta = damping_of_restitution(e);
    // Richardson: the error of the step is taken out to its first order.
    const double found = 2.0 * given_back(zeta, 1e-5) - given_back(zeta, 2e-5);
    EXPECT_NEAR(found, e, 1e-4) << zeta;
  }
  EXPECT_NEAR(damping_of_restitution(std::exp(-2.0)), 1.0, 1e-6);
  EXPECT_NEAR(damping_of_restitution(1.0), 0.0, 1e-12);
}

}  // namespace
}  // namespace tissu
