#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../base/random.h"
#include "tissu/contact/boxes.h"

namespace tissu {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Outwards, and by no more than to the next number of single precision.
TEST(Box, IsRoundedOutwardsOnce) {
  test::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point = std::pow(10.0, 40.0 * random.number()) * random.vector();
    if (point.cwiseAbs().maxCoeff() > 3e38) continue;
    Box box = Box::none();
    box.add(point);
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = point[static_cast<Eigen::Index>(k)];
      EXPECT_LE(static_cast<double>(box.low[k]), x);
      EXPECT_GE(static_cast<double>(box.high[k]), x);
      EXPECT_LE(box.high[k], std::nextafter(box.low[k], kInfinity));
    }
  }
}

TEST(Box, NumbersOfSinglePrecisionStayAsTheyAre) {
  Box box = Box::none();
  box.add(Vec3(0.25, -3.0, 0.0));
  EXPECT_EQ(box.low, (std::array<float, 3>{0.25F, -3.0F, 0.0F}));
  EXPECT_EQ(box.high, box.low);
  box.grow(0.5);
  EXPECT_EQ(box.low, (std::array<float, 3>{-0.25F, -3.5F, -0.5F}));
  EXPECT_EQ(box.high, (std::array<float, 3>{0.75F, -2.5F, 0.5F}));
}

// What the round-off of double precision swallows is not lost.
TEST(Box, GrowsByTheSmallest) {
  for (const float at : {0.0F, 1.0F, -1.0F, 1e30F, -1e30F}) {
    Box box{{at, at, at}, {at, at, at}};
    box.grow(1e-42);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(box.low[k], at);
      EXPECT_GT(box.high[k], at);
    }
  }
}

TEST(Box, BoxesThatTouchOverlap) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(box.overlaps({{1, 1, 1}, {2, 2, 2}}));
  EXPECT_TRUE(box.overlaps({{-1, 0, 0}, {0, 1, 1}}));
  for (std::size_t k = 0; k < 3; ++k) {
    Box other = box;
    other.low[k] = std::nextafter(1.0F, 2.0F);
    other.high[k] = 2.0F;
    EXPECT_FALSE(box.overlaps(other));
    EXPECT_FALSE(other.overlaps(box));
  }
}

// A search refuses what is not a number, so it must not be lost on the way there.
TEST(Box, KeepsWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int when : {0, 1, 2}) {
    Box box = Box::none();
    for (int i = 0; i < 3; ++i) box.add(i == when ? Vec3(0.0, nan, 0.0) : Vec3(1.0, 2.0, 3.0));
    Box other{{0, 0, 0}, {1, 1, 1}};
    other.add(box);
    other.grow(0.1);
    EXPECT_TRUE(std::isnan(other.low[1]) && std::isnan(other.high[1]));
    EXPECT_FALSE(std::isnan(other.low[0]) || std::isnan(other.high[2]));
  }
}

}  // namespace
}  // namespace tissu
