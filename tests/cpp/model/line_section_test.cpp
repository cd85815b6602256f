#include "tissu/model/line_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tissu/base/error.h"

namespace tissu {
namespace {

using enum LineSection::Shape;

/// Timoshenko and Goodier, Theory of Elasticity, section 109, table: J / (a b^3), as it is printed.
TEST(LineSection, RectanglesTwistByThePublishedTable) {
  EXPECT_NEAR(rectangle_torsion(1.0, 1.0), 0.1406, 5e-5);
  EXPECT_NEAR(rectangle_torsion(1.2, 1.0) / 1.2, 0.166, 5e-4);
  EXPECT_NEAR(rectangle_torsion(1.0, 1.5) / 1.5, 0.196, 5e-4);
  EXPECT_NEAR(rectangle_torsion(2.0, 1.0) / 2.0, 0.229, 5e-4);
  EXPECT_NEAR(rectangle_torsion(5.0, 1.0) / 5.0, 0.291, 5e-4);
  EXPECT_NEAR(rectangle_torsion(1e4, 1.0) / 1e4, 1.0 / 3.0, 1e-4);
  EXPECT_DOUBLE_EQ(rectangle_torsion(0.3, 0.7), rectangle_torsion(0.7, 0.3));
}

/// Cowper's factors in their limits: a tube without a hole is round, one of a thin wall has 2 (1 + nu) / (4 +
/// 3 nu).
TEST(LineSection, ShearFactorsAreCowpers) {
  const double nu = 0.3;
  const auto round_k = section_constants({.shape = round}, 1.0, nu).shear_up;
  EXPECT_NEAR(round_k, 0.886, 5e-4);
  EXPECT_NEAR(section_constants({.shape = tube, .sizes = {1.0, 0.0}}, 1.0, nu).shear_up, round_k, 1e-15);
  EXPECT_NEAR(section_constants({.shape = tube, .sizes = {1.0, 1.0 - 1e-9}}, 1.0, nu).shear_up,
              2.0 * (1.0 + nu) / (4.0 + 3.0 * nu), 1e-8);
  const auto flat = section_constants({.shape = rectangle, .sizes = {2.0, 1.0}}, 2.0, 0.0);
  EXPECT_NEAR(flat.shear_up, 5.0 / 6.0, 1e-15);  // without Poisson's ratio that of a parabola of shear
  EXPECT_NEAR(flat.inertia_up, 8.0 / 12.0, 1e-15);
  EXPECT_NEAR(flat.inertia_across, 2.0 / 12.0, 1e-15);
}

TEST(LineSection, RoundSectionsComeOfTheirArea) {
  const auto constants = section_constants({}, std::numbers::pi * 4.0, 0.0);
  EXPECT_NEAR(constants.inertia_up, std::numbers::pi * 4.0, 1e-12);
  EXPECT_NEAR(constants.torsion, std::numbers::pi * 8.0, 1e-12);
}

TEST(LineSection, UnknownShapesAreRefused) { EXPECT_THROW(section_shape("square"), ParameterError); }

}  // namespace
}  // namespace tissu
