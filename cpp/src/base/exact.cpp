// Compiled without contraction to fused products (cpp/CMakeLists.txt): a head and its tail are rounded as
// they are written.
#include "tissu/base/exact.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#ifdef __FAST_MATH__
#error "exact.cpp depends on IEEE arithmetic; compile it without -ffast-math."
#endif

namespace tissu {
namespace {

/// Of the determinant in double, as a share of its permanent in double. A product of three differences passes
/// at most 8 roundings (3 differences, 2 products, 3 sums), each within 2^-53 of what it rounds, and so does
/// the permanent: |error| <= ((1 + u)^8 - 1) / (1 - u)^8 permanents < 10 u permanents.
constexpr double kErrorShare = 5.0 * std::numeric_limits<double>::epsilon();

/// An unevaluated sum of two doubles, of which the head is the rounded value.
struct Pair {
  double head;
  double tail;
};

Pair sum(double a, double b) {
  const double head = a + b;
  const double of_b = head - a;
  const double of_a = head - of_b;
  return {head, (a - of_a) + (b - of_b)};
}

Pair product(double a, double b) {
  const double head = a * b;
  return {head, std::fma(a, b, -head)};
}

/// A sum of doubles without round-off: its parts do not overlap and grow in size, so that the last has the
/// sign of all (Shewchuk 1997, theorem 10).
class Expansion {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const Pair next = sum(value, parts_[i]);
      if (next.tail != 0.0) parts_[kept++] = next.tail;
      value = next.head;
    }
    if (value != 0.0) parts_[kept++] = value;
    size_ = kept;
  }
  void add_product(double a, double b, double c) {
    const Pair ab = product(a, b);
    for (const double factor : {ab.tail, ab.head}) {
      const Pair abc = product(factor, c);
      add(abc.tail);
      add(abc.head);
    }
  }
  [[nodiscard]] int sign() const {
    if (size_ == 0) return 0;
    return parts_[size_ - 1] > 0.0 ? 1 : -1;
  }

 private:
  /// Each of 6 products of three differences has 8 products of their heads and tails, of 4 parts each.
  std::array<double, 192> parts_;
  std::size_t size_ = 0;
};

using PairVec = std::array<Pair, 3>;

PairVec difference(const Vec3& a, const Vec3& b) {
  return {sum(a[0], -b[0]), sum(a[1], -b[1]), sum(a[2], -b[2])};
}

/// Adds sign * a * b * c.
void add_product(Expansion& to, double sign, const Pair& a, const Pair& b, const Pair& c) {
  for (const double x : {a.tail, a.head}) {
    if (x == 0.0) continue;
    for (const double y : {b.tail, b.head}) {
      if (y == 0.0) continue;
      for (const double z : {c.tail, c.head}) {
        if (z != 0.0) to.add_product(sign * x, y, z);
      }
    }
  }
}

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const PairVec u = difference(b, a);
  const PairVec v = difference(c, a);
  const PairVec w = difference(d, a);
  Expansion determinant;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    add_product(determinant, 1.0, u[i], v[j], w[k]);
    add_product(determinant, -1.0, u[i], v[k], w[j]);
  }
  return determinant.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  double determinant = 0.0;
  double permanent = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double plus = v[(i + 1) % 3] * w[(i + 2) % 3];
    const double minus = v[(i + 2) % 3] * w[(i + 1) % 3];
    determinant += u[i] * (plus - minus);
    permanent += std::abs(u[i]) * (std::abs(plus) + std::abs(minus));
  }
  const double error = kErrorShare * permanent;
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  return exact_orientation(a, b, c, d);
}

}  // namespace tissu
