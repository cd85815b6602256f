#include "tissu/edit/cut/severed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tissu/base/error.h"

namespace tissu {
namespace {

Sweep plane_at(double z, double up) {
  return plane_sweep(Vec3(0, 0, z), Vec3(0, 0, up), Vec3(-1, -1, -1), Vec3(1, 1, 1));
}

TEST(SeveredTest, ASegmentIsSeveredWhereItsEndsLieOnBothSidesOfAPlane) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in_box(-1.0, 1.0);
  std::vector<double> a(3000);
  std::vector<double> b(3000);
  for (double& x : a) x = in_box(random);
  for (double& x : b) x = in_box(random);
  const std::vector<char> found = severed(plane_at(0.25, 1.0), a, b);
  int many = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i] != 0, (a[3 * i + 2] < 0.25) != (b[3 * i + 2] < 0.25)) << i;
    many += found[i];
  }
  EXPECT_GT(many, 200);
}

TEST(SeveredTest, ADiscSeversWithinItsRimAlone) {
  const Sweep disc = disc_sweep(Vec3(0, 0, 0), Vec3(0, 0, 1), 1.0);
  // A polygon of 32 sides lies between circles of cos(pi / 32) and 1.
  for (const double r : {0.0, 0.3, 0.99, 1.01, 2.0}) {
    for (int k = 0; k < 64; ++k) {
      const double angle = 0.1 + 0.0981747704 * k;
      const std::vector<double> a{r * std::cos(angle), r * std::sin(angle), -0.5};
      const std::vector<double> b{r * std::cos(angle), r * std::sin(angle), 0.5};
      EXPECT_EQ(severed(disc, a, b)[0] != 0, r < 1.0) << r << " at " << angle;
      EXPECT_EQ(severed(disc, b, a)[0] != 0, r < 1.0);
    }
  }
}

TEST(SeveredTest, APointOnTheBladeStaysWithTheSideOfItsNormal) {
  const std::vector<double> on{0.125, 0.25, 0.5};
  const std::vector<double> above{0.3, -0.2, 0.75};
  const std::vector<double> below{0.3, -0.2, 0.25};
  const std::vector<double> beside{-0.5, 0.625, 0.5};
  for (const double up : {1.0, -1.0}) {
    const Sweep plane = plane_at(0.5, up);
    EXPECT_EQ(severed(plane, on, above)[0] != 0, up < 0.0);
    EXPECT_EQ(severed(plane, below, on)[0] != 0, up > 0.0);
    EXPECT_EQ(severed(plane, on, beside)[0], 0);
    EXPECT_NE(severed(plane, above, below)[0], 0);
  }
}

TEST(SeveredTest, EndsThatAreNotPairsAreRefused) {
  const std::vector<double> one{0, 0, 0};
  const std::vector<double> two{0, 0, 0, 1, 1, 1};
  EXPECT_THROW((void)severed(plane_at(0.5, 1.0), one, two), ParameterError);
}

}  // namespace
}  // namespace tissu
