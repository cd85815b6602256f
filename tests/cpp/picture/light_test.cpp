#include "tissu/picture/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tissu {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
const std::vector<std::int64_t> kOne = {0, 1, 2};

/// A triangle that covers all of 4 x 4 pixels, the normal of its corners given.
Canvas lit(const std::vector<double>& normal, double towards, const Paint& paint) {
  const Seen seen = rasterise(std::vector<double>{0, 0, 1, 20, 0, 1, 0, 20, 1}, kOne, 4, 4);
  std::vector<double> normals;
  for (int k = 0; k < 3; ++k) normals.insert(normals.end(), normal.begin(), normal.end());
  return light(seen, normals, std::vector<double>{towards}, paint, 4, 4);
}

const Paint kClay{{0.8, 0.5, 0.4}, {}, {}, 0.0, 1.0};

/// But for the gloss, 0.14 c^40 with c = h_z of the half vector between the key light and the viewer.
TEST(LightTest, WhatFacesTheViewerKeepsItsColour) {
  const double key_z = 0.66 / std::sqrt(0.45 * 0.45 + 0.60 * 0.60 + 0.66 * 0.66);
  const double gloss = 0.14 * std::pow(std::sqrt(0.5 * (1.0 + key_z)), 40.0);
  const Canvas canvas = lit({0, 0, 1}, 1.0, kClay);
  for (std::size_t i = 0; i < canvas.colour.size(); ++i) {
    EXPECT_NEAR(canvas.colour[i], kClay.colour[i % 3] + gloss, 1e-14);
  }
}

TEST(LightTest, FromBehindItIsLitLikeFromTheFront) {
  EXPECT_EQ(lit({0.1, 0.2, 0.97}, 1.0, kClay).colour, lit({-0.1, -0.2, -0.97}, -1.0, kClay).colour);
}

TEST(LightTest, LightComesFromAbove) {
  EXPECT_GT(lit({0, 0.6, 0.8}, 1.0, kClay).colour[0], lit({0, -0.6, 0.8}, 1.0, kClay).colour[0] + 0.1);
}

TEST(LightTest, ValuesTakeTheirPartOfTheTable) {
  // Two parts, red and green; below blue, above white, no number black.
  const std::vector<double> table = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0};
  const auto colour = [&](double value) {
    const std::vector<double> values(3, value);
    const Canvas canvas = lit({0, 0, 1}, 1.0, {{}, values, table, 10.0, 20.0});
    std::vector<long> rounded;
    for (std::size_t k = 0; k < 3; ++k) rounded.push_back(std::lround(canvas.colour[k]));
    return rounded;
  };
  EXPECT_EQ(colour(10.0), (std::vector<long>{1, 0, 0}));
  EXPECT_EQ(colour(14.9), (std::vector<long>{1, 0, 0}));
  EXPECT_EQ(colour(15.1), (std::vector<long>{0, 1, 0}));
  EXPECT_EQ(colour(20.0), (std::vector<long>{0, 1, 0}));
  EXPECT_EQ(colour(9.0), (std::vector<long>{0, 0, 1}));
  EXPECT_EQ(colour(21.0), (std::vector<long>{1, 1, 1}));
  EXPECT_EQ(colour(std::nan("")), (std::vector<long>{0, 0, 0}));
}

TEST(LightTest, TheNearSideOfAJumpIsDarker) {
  // A row of steps: flat, a jump by 10 between the third and the fourth pixel, flat; nothing at the end.
  Canvas canvas{6, 1, std::vector<double>(18, 1.0), {0, 0, 0, 10, 10, -kFar}};
  darken_edges(6.0, canvas);
  const std::vector<double> wanted = {1, 1, 1, 0.55, 1, 1};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(canvas.colour[3 * i], wanted[i]) << i;
  Canvas steep{6, 1, std::vector<double>(18, 1.0), {0, 10, 20, 30, 40, 50}};
  darken_edges(6.0, steep);
  EXPECT_EQ(steep.colour, std::vector<double>(18, 1.0));
}

TEST(LightTest, ShownPixelsAreMeansOfTheFinerOnes) {
  // Of four finer pixels two are covered, in two colours.
  const std::vector<double> colour = {1, 0, 0, 9, 9, 9, 9, 9, 9, 0, 1, 0};
  const std::vector<double> shown = shown_pixels(colour, std::vector<double>{1, 0, 0, 1}, 2, 2, 2);
  EXPECT_EQ(shown, (std::vector<double>{0.5, 0.5, 0.0, 0.5}));
  EXPECT_EQ(shown_pixels(colour, std::vector<double>(4, 0.0), 2, 2, 2), std::vector<double>(4, 0.0));
}

}  // namespace
}  // namespace tissu
