#include "tissu/base/exact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace tissu {
namespace {

__extension__ using Wide = __int128;
using Whole = std::array<std::int64_t, 3>;

int sign_of(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

Vec3 real(const Whole& p, double scale = 1.0) {
  return scale * Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
}

/// Of whole coordinates below 2^40.
int whole_orientation(const Whole& a, const Whole& b, const Whole& c, const Whole& d) {
  Wide sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    sum += Wide{b[i] - a[i]} * (Wide{c[j] - a[j]} * (d[k] - a[k]) - Wide{c[k] - a[k]} * (d[j] - a[j]));
  }
  return sign_of(sum);
}

int rounded_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double determinant = (b - a).cross(c - a).dot(d - a);
  return determinant > 0.0 ? 1 : determinant < 0.0 ? -1 : 0;
}

class ExactTest : public testing::Test {
 protected:
  std::int64_t whole(std::int64_t size) {
    return std::uniform_int_distribution<std::int64_t>(-size, size)(random_);
  }
  Whole point(std::int64_t size) {
    const std::int64_t x = whole(size);
    const std::int64_t y = whole(size);
    return {x, y, whole(size)};
  }
  std::mt19937_64 random_{1};
};

TEST_F(ExactTest, OfWholeCoordinatesItIsTheSignOfTheWholeDeterminant) {
  std::array<int, 3> seen{};
  int wrong_in_double = 0;
  for (int number = 0; number < 200'000; ++number) {
    const std::int64_t size = number % 2 == 0 ? 3 : std::int64_t{1} << 38;
    const Whole a = point(size / 8 + 1);
    const Whole b = point(size);
    const Whole c = point(size);
    Whole d = point(size);
    if (number % 4 == 3) {  // in the plane or at most a unit off it
      for (std::size_t i = 0; i < 3; ++i) d[i] = b[i] + c[i] - a[i];
      d[static_cast<std::size_t>(number / 4 % 3)] += whole(1);
    }
    const int sign = whole_orientation(a, b, c, d);
    ++seen[static_cast<std::size_t>(sign + 1)];
    for (const double scale : {1.0, 0x1p-305, 0x1p297}) {  // both ends of the range that is stated
      EXPECT_EQ(orientation(real(a, scale), real(b, scale), real(c, scale), real(d, scale)), sign);
    }
    if (rounded_orientation(real(a), real(b), real(c), real(d)) != sign) ++wrong_in_double;
  }
  for (const int times : seen) EXPECT_GT(times, 1000);
  EXPECT_GT(wrong_in_double, 1000);  // or the test is too easy
}

/// Points of the plane x + y + z = 0 whose sizes are so unlike that their differences are rounded, and d at
/// most a little off it along z: the determinant is then that of the shadow on x y, times how far.
TEST_F(ExactTest, DifferencesThatAreRoundedChangeNoSign) {
  const auto in_plane = [&] {
    std::int64_t x = 0;
    std::int64_t y = 0;
    do {
      const auto shift = static_cast<int>(whole(15) + 15);
      x = whole(1 << 28) * (std::int64_t{1} << shift);
      y = whole(1 << 28) * (std::int64_t{1} << (15 + whole(15)));
    } while (static_cast<std::int64_t>(static_cast<double>(x + y)) != x + y);
    return Whole{x, y, -(x + y)};
  };
  int rounded = 0;
  for (int number = 0; number < 100'000; ++number) {
    const Whole a = in_plane();
    const Whole b = in_plane();
    const Whole c = in_plane();
    Whole d = in_plane();
    const std::int64_t off = whole(1);
    d[2] += off;
    if (static_cast<std::int64_t>(static_cast<double>(d[2])) != d[2]) continue;
    const Wide shadow = Wide{b[0] - a[0]} * (c[1] - a[1]) - Wide{b[1] - a[1]} * (c[0] - a[0]);
    EXPECT_EQ(orientation(real(a), real(b), real(c), real(d)), sign_of(shadow) * static_cast<int>(off));
    if (static_cast<std::int64_t>(static_cast<double>(b[0] - a[0])) != b[0] - a[0]) ++rounded;
  }
  EXPECT_GT(rounded, 1000);
}

TEST_F(ExactTest, ExchangingTwoPointsChangesTheSign) {
  for (int number = 0; number < 20'000; ++number) {
    // Next to the diagonal plane, a few last digits off: 0.1 + k 2^-56 is a grid of doubles.
    std::array<Vec3, 4> p;
    for (Vec3& point : p) {
      const double place = 0.1 + 0x1p-56 * static_cast<double>(whole(40));
      point = {place, number % 2 == 0 ? place : 12.0 + place, 24.0 * static_cast<double>(whole(2))};
      point[static_cast<int>(whole(1) + 1)] += 0x1p-52 * static_cast<double>(whole(2));
    }
    std::array<std::size_t, 4> order = {0, 1, 2, 3};
    const int sign = orientation(p[0], p[1], p[2], p[3]);
    do {
      int turns = 1;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) turns *= order[j] > order[i] ? -1 : 1;
      }
      EXPECT_EQ(orientation(p[order[0]], p[order[1]], p[order[2]], p[order[3]]), turns * sign);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST_F(ExactTest, OnTheSideOfTheNormalItIsPositive) {
  const Vec3 a(0, 0, 0);
  const Vec3 b(1, 0, 0);
  const Vec3 c(0, 1, 0);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.3, 0.3, 1e-90)), 1);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.3, 0.3, -1e-90)), -1);
  EXPECT_EQ(orientation(a, b, c, Vec3(0.3, 0.3, 0)), 0);
}

}  // namespace
}  // namespace tissu
