#include "tissu/contact/boxes.h"

#include <bit>
#include <limits>

namespace tissu {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The next number below a finite one.
float next_below(float x) {
  if (x == 0.0F) return -std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>(x > 0.0F ? bits - 1 : bits + 1);
}

/// The largest number in single precision that is at most x + rest, where |rest| is below the round-off of x.
float round_down(double x, double rest) {
  const auto nearest = static_cast<float>(x);
  const auto back = static_cast<double>(nearest);
  const bool above = back > x || (back == x && rest < 0.0);
  if (!above) return nearest;
  return nearest == kInfinity ? std::numeric_limits<float>::max() : next_below(nearest);
}

/// a - b, rounded down once: the sum in double precision and its error, which is exact (Knuth's two-sum).
float subtract_down(double a, double b) {
  const double sum = a - b;
  const double of_b = sum - a;
  return round_down(sum, (a - (sum - of_b)) - (b + of_b));
}

/// NaN, once in a box, stays there: the search refuses it.
float least(float kept, float other) { return other >= kept || kept != kept ? kept : other; }
float greatest(float kept, float other) { return other <= kept || kept != kept ? kept : other; }

}  // namespace

Box Box::none() { return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}}; }

void Box::add(const Vec3& point) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = point[static_cast<Eigen::Index>(k)];
    low[k] = least(low[k], round_down(x, 0.0));
    high[k] = greatest(high[k], -round_down(-x, 0.0));
  }
}

void Box::add(const Box& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = least(low[k], other.low[k]);
    high[k] = greatest(high[k], other.high[k]);
  }
}

void Box::grow(double by) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = subtract_down(static_cast<double>(low[k]), by);
    high[k] = -subtract_down(-static_cast<double>(high[k]), by);
  }
}

}  // namespace tissu
