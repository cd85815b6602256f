#include "tissu/picture/raster.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tissu {
namespace {

const std::vector<std::int64_t> kOne = {0, 1, 2};

TEST(RasterTest, ATriangleCoversThePixelsWhoseMiddlesLieInIt) {
  // Half of a square of 8 x 8 pixels: of the middles, those above the diagonal, 7 + 6 + ... + 0 of them, and
  // of the eight on it those that the edge gives to one side only.
  const Seen seen = rasterise(std::vector<double>{0, 0, 1, 8, 0, 1, 0, 8, 1}, kOne, 10, 10);
  EXPECT_EQ(seen.pixel.size(), 28U);
  for (const std::int64_t pixel : seen.pixel) EXPECT_LT(pixel % 10 + pixel / 10 + 1, 8);
}

TEST(RasterTest, TwoTrianglesOfASquareCoverEachPixelOnce) {
  const std::vector<double> corners = {0, 0, 0, 8, 0, 0, 8, 8, 0, 0, 8, 0};
  const Seen both = rasterise(corners, std::vector<std::int64_t>{0, 1, 2, 0, 2, 3}, 8, 8);
  const Seen first = rasterise(corners, std::vector<std::int64_t>{0, 1, 2}, 8, 8);
  const Seen second = rasterise(corners, std::vector<std::int64_t>{0, 2, 3}, 8, 8);
  EXPECT_EQ(both.pixel.size(), 64U);
  EXPECT_EQ(first.pixel.size() + second.pixel.size(), 64U);
}

TEST(RasterTest, WeightsAndNearnessAreThoseOfThePlane) {
  const std::vector<double> corners = {1, 2, 3, 17, 4, -5, 6, 19, 11};
  const Seen seen = rasterise(corners, kOne, 20, 20);
  ASSERT_GT(seen.pixel.size(), 50U);
  for (std::size_t i = 0; i < seen.pixel.size(); ++i) {
    const double* const w = &seen.weights[3 * i];
    double at[3] = {};
    for (std::size_t k = 0; k < 9; ++k) at[k % 3] += w[k / 3] * corners[k];
    EXPECT_NEAR(at[0], static_cast<double>(seen.pixel[i] % 20) + 0.5, 1e-12);
    EXPECT_NEAR(at[1], static_cast<double>(seen.pixel[i] / 20) + 0.5, 1e-12);
    EXPECT_NEAR(at[2], seen.nearness[i], 1e-12);
  }
}

TEST(RasterTest, TheNearerTriangleIsSeenWhateverTheOrder) {
  const std::vector<double> corners = {0, 0, 1, 9, 0, 1, 0, 9, 1, 0, 0, 2, 9, 0, 2, 0, 9, 2};
  for (const std::vector<std::int64_t>& order :
       {std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}, std::vector<std::int64_t>{3, 4, 5, 0, 1, 2}}) {
    const Seen seen = rasterise(corners, order, 9, 9);
    for (const double near : seen.nearness) EXPECT_EQ(near, 2.0);
  }
}

TEST(RasterTest, WhatIsBesideThePictureOrNotFiniteIsNotDrawn) {
  EXPECT_TRUE(rasterise(std::vector<double>{20, 0, 0, 30, 0, 0, 20, 9, 0}, kOne, 10, 10).pixel.empty());
  const double none = std::nan("");
  EXPECT_TRUE(rasterise(std::vector<double>{0, 0, 0, 9, none, 0, 0, 9, 0}, kOne, 10, 10).pixel.empty());
  const Seen cut = rasterise(std::vector<double>{-5, -5, 0, 40, -5, 0, -5, 40, 0}, kOne, 10, 10);
  EXPECT_EQ(cut.pixel.size(), 100U);
}

}  // namespace
}  // namespace tissu
