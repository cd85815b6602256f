#include "tissu/contact/penalty_law.h"

#include <gtest/gtest.h>

/// Springs of the penalty method against their formulas.

namespace tissu {
namespace {

constexpr double kStiffness = 3e4;  ///< [N/m]
constexpr double kRange = 2e-3;     ///< s0 [m]

TEST(PenaltyLaw, IsItsFormula) {
  const double depth = 4e-4;
  EXPECT_DOUBLE_EQ(spring_force(PenaltyLaw::linear, kStiffness, depth, kRange).force, kStiffness * depth);
  const double k1 = 0.25 * kStiffness * kRange * kRange;
  const SpringForce found = spring_force(PenaltyLaw::reciprocal, kStiffness, depth, kRange);
  EXPECT_DOUBLE_EQ(found.force, k1 * (1.0 / (kRange - depth) - 1.0 / kRange));
  EXPECT_EQ(spring_force(PenaltyLaw::reciprocal, kStiffness, 0.0, kRange).force, 0.0);
}

/// Central differences leave 1e-6 of the third derivative, a step of 1e-3 of s0.
TEST(PenaltyLaw, SlopesAreThoseOfTheForce) {
  const double h = 1e-3 * kRange;
  for (const PenaltyLaw law : {PenaltyLaw::linear, PenaltyLaw::reciprocal}) {
    for (const double share : {0.1, 0.3, 0.45, 0.6, 0.9, 1.2}) {
      const double depth = share * kRange;
      const double low = spring_force(law, kStiffness, depth - h, kRange).force;
      const double high = spring_force(law, kStiffness, depth + h, kRange).force;
      const SpringForce found = spring_force(law, kStiffness, depth, kRange);
      EXPECT_NEAR((high - low) / (2.0 * h), found.slope, 1e-5 * kStiffness) << share;
      EXPECT_LE(found.slope, kStiffness * (1.0 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace tissu
