#include "tissu/base/crossing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pair_samples.h"
#include "tissu/contact/closest.h"

namespace tissu {
namespace {

/// On the grid of halves from -1 to 1 what does not touch is farther apart than this, and what touches is
/// nearer in double.
constexpr double kTouch = 1e-9;

bool has_area(const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]).norm() > kTouch; }

/// By distances and by solving for the place where the segment meets the plane.
bool touches(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t) {
  Part part{};
  Part other{};
  double square = std::min(closest_point_triangle({a, t[0], t[1], t[2]}, part).square,
                           closest_point_triangle({b, t[0], t[1], t[2]}, part).square);
  for (std::size_t i = 0; i < 3; ++i) {
    square = std::min(square, closest_edge_edge({a, b, t[i], t[(i + 1) % 3]}, part, other).square);
  }
  if (square < kTouch * kTouch) return true;
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double slope = normal.dot(b - a);
  if (std::abs(slope) < kTouch) return false;
  const double share = normal.dot(t[0] - a) / slope;
  const Vec3 place = a + share * (b - a);
  return share >= 0.0 && share <= 1.0 &&
         closest_point_triangle({place, t[0], t[1], t[2]}, part).square < kTouch * kTouch;
}

TEST(CrossingTest, OnAGridItIsWhatDistancesSay) {
  PairSamples samples(1);
  int crossing = 0;
  int in_plane = 0;
  for (int number = 0; number < 200'000; ++number) {
    const Vec3 a = samples.grid_vector();
    const Vec3 b = samples.grid_vector();
    const std::array<Vec3, 3> triangle = {samples.grid_vector(), samples.grid_vector(),
                                          samples.grid_vector()};
    const bool expected = has_area(triangle) && touches(a, b, triangle);
    EXPECT_EQ(crosses(a, b, triangle), expected);
    EXPECT_EQ(crosses(b, a, {triangle[2], triangle[1], triangle[0]}), expected);
    if (!expected) continue;
    ++crossing;
    const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    if (normal.dot(a - triangle[0]) == 0.0 && normal.dot(b - triangle[0]) == 0.0) ++in_plane;
  }
  EXPECT_GT(crossing, 20'000);
  EXPECT_GT(in_plane, 1000);
}

TEST(CrossingTest, TheLastDigitDecides) {
  const std::array<Vec3, 3> triangle = {Vec3(0.1, 0.1, 0.1), Vec3(0.7, 0.1, 0.1), Vec3(0.1, 0.7, 0.1)};
  const auto after = [](double value) { return std::nextafter(value, 1.0); };
  const auto before = [](double value) { return std::nextafter(value, 0.0); };
  const Vec3 above(0.2, 0.3, 0.5);
  EXPECT_TRUE(crosses(above, Vec3(0.2, 0.3, 0.1), triangle));
  EXPECT_TRUE(crosses(above, Vec3(0.2, 0.3, before(0.1)), triangle));
  EXPECT_FALSE(crosses(above, Vec3(0.2, 0.3, after(0.1)), triangle));
  // Along z through the side y = 0.1, and a digit off it.
  EXPECT_TRUE(crosses(Vec3(0.3, 0.1, 1), Vec3(0.3, 0.1, -1), triangle));
  EXPECT_FALSE(crosses(Vec3(0.3, before(0.1), 1), Vec3(0.3, before(0.1), -1), triangle));
  // In its plane, up to the side and a digit short of it.
  EXPECT_TRUE(crosses(Vec3(0.3, 0, 0.1), Vec3(0.3, 0.1, 0.1), triangle));
  EXPECT_FALSE(crosses(Vec3(0.3, 0, 0.1), Vec3(0.3, before(0.1), 0.1), triangle));
}

}  // namespace
}  // namespace tissu
