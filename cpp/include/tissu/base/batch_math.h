#pragma once

/// Logarithm, exponential and cube roots of a batch: no call, no table, no branch, every lane alike, and only
/// operations that SSE2 has. Polynomials are minimax, found by Remez' exchange in 50 digits; their own error
/// is named beside them. Largest errors measured against 80-bit arithmetic over the whole range, denormals
/// included, with and without fused multiply-adds (tests/cpp/base/batch_math_test.cpp):
///   log 0.79 ulp, exp 1.06 ulp, cbrt 0.50 ulp, inverse_cbrt 1.27 ulp.

#include "tissu/base/batch.h"

namespace tissu::TISSU_KERNELS {

using BatchBits = std::uint64_t __attribute__((vector_size(kWidth * sizeof(double))));

inline constexpr std::uint64_t kMantissa = 0x000fffffffffffff;
inline constexpr std::uint64_t kExponentOne = 0x3ff0000000000000;  ///< the bits of 1.0
inline constexpr double kInfinity = __builtin_inf();

TISSU_INLINE BatchBits bits_of(Batch a) { return (BatchBits)a.v; }
TISSU_INLINE Batch from_bits(BatchBits bits) { return {(Batch::Native)bits}; }
TISSU_INLINE BatchBits all(std::uint64_t bits) { return bits - BatchBits{}; }

/// A batch of whole numbers below 2^52, given as bits, as doubles.
TISSU_INLINE Batch whole(BatchBits bits) { return from_bits(bits | all(0x4330000000000000)) - Batch(0x1p52); }

/// 1.5 * 2^52: added to a number, leaves it rounded to a whole one in its lowest bits.
inline constexpr double kRound = 0x1.8p52;

/// 2^k for whole k in [-1022, 1023]; `shifted` is k + kRound.
TISSU_INLINE Batch power_of_two(Batch shifted) { return from_bits((bits_of(shifted) + all(1023)) << 52); }

/// c[0] + c[1] x + … + c[count - 1] x^(count - 1), halves first: short chains of dependent operations.
template <int kCount>
TISSU_INLINE Batch polynomial(const double* c, Batch x, Batch x2, Batch x4, Batch x8) {
  if constexpr (kCount == 1) {
    return Batch(c[0]);
  } else if constexpr (kCount == 2) {
    return Batch(c[0]) + x * Batch(c[1]);
  } else {
    constexpr int kHalf = kCount > 8 ? 8 : kCount > 4 ? 4 : 2;
    const Batch power = kHalf == 8 ? x8 : kHalf == 4 ? x4 : x2;
    return polynomial<kHalf>(c, x, x2, x4, x8) + power * polynomial<kCount - kHalf>(c + kHalf, x, x2, x4, x8);
  }
}
template <int kCount>
TISSU_INLINE Batch polynomial(const double (&c)[kCount], Batch x) {
  const Batch x2 = x * x;
  const Batch x4 = x2 * x2;
  return polynomial<kCount>(c, x, x2, x4, x4 * x4);
}

/// Natural logarithm. x = 2^k z with z in [sqrt(1/2), sqrt(2)), f = z - 1, s = f / (2 + f):
///   ln x = k ln 2 + 2 atanh(s) = k ln 2 + f - (f^2 / 2 - s (f^2 / 2 + s^2 R(s^2))),  R(t) = 2/3 + 2/5 t + …
/// -infinity at 0, NaN below.
TISSU_INLINE Batch log(Batch x) {
  // R on [0, 0.02945], to 2^-56.6 of f.
  constexpr double kR[] = {0.666666666666667,   0.3999999999989789, 0.28571428626650963, 0.2222221103180599,
                           0.18182896203998564, 0.1533149788057244, 0.14619095556025327};
  constexpr double kLn2High = 0.693147180559663;  // 41 bits, so that k * kLn2High is exact
  constexpr double kLn2Low = 2.8235290563031577e-13;
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;  // the bits of sqrt(1/2)
  const auto tiny = x.v < Batch(0x1p-1022).v;
  const Batch scaled(tiny ? (x * Batch(0x1p54)).v : x.v);
  const BatchBits above = bits_of(scaled) + all(kExponentOne - kRootHalf);
  const Batch k = whole(above >> 52) - Batch(tiny ? Batch(1023.0 + 54.0).v : Batch(1023.0).v);
  const Batch f = from_bits((above & all(kMantissa)) + all(kRootHalf)) - Batch(1.0);
  const Batch s = f / (Batch(2.0) + f);
  const Batch t = s * s;
  const Batch half = Batch(0.5) * f * f;
  const Batch tail = s * (half + t * polynomial(kR, t)) + k * Batch(kLn2Low);
  const Batch result = k * Batch(kLn2High) - ((half - tail) - f);
  const Batch at_zero(x.v == Batch(0.0).v ? Batch(-kInfinity).v : Batch(__builtin_nan("")).v);
  const Batch usual(x.v < Batch(kInfinity).v ? result.v : x.v);
  return {x.v > Batch(0.0).v ? usual.v : at_zero.v};
}

/// Exponential. x = k ln 2 + r, |r| <= ln(2) / 2:  e^x = 2^k (1 + (r + r^2 Q(r))).
TISSU_INLINE Batch exp(Batch x) {
  // Q on [-0.347, 0.347], to 2^-56.2 of 1.
  constexpr double kQ[] = {0.5000000000000001,     0.16666666666666674,    0.04166666666662381,
                           0.008333333333322127,   0.0013888888917370768,  0.00019841269886836392,
                           2.4801521052948772e-05, 2.7557242059340425e-06, 2.7620203638894305e-07,
                           2.5110154340462048e-08};
  constexpr double kLn2High = 0.693147180559663;
  constexpr double kLn2Low = 2.8235290563031577e-13;
  constexpr double kInverseLn2 = 1.4426950408889634;
  const Batch below(x.v > Batch(710.0).v ? Batch(710.0).v : x.v);  // infinity from 709.8 on, NaN stays
  const Batch y(below.v < Batch(-746.0).v ? Batch(-746.0).v : below.v);
  const Batch k = (y * Batch(kInverseLn2) + Batch(kRound)) - Batch(kRound);
  const Batch r = (y - k * Batch(kLn2High)) - k * Batch(kLn2Low);
  const Batch value = Batch(1.0) + (r + r * r * polynomial(kQ, r));
  const Batch first = k * Batch(0.5) + Batch(kRound);  // 2^k in two factors: k reaches 1024 and -1076
  const Batch second = (k - (first - Batch(kRound))) + Batch(kRound);
  return value * power_of_two(first) * power_of_two(second);
}

/// |x| = 8^q y with y in [1, 8).
struct CubeParts {
  Batch y;
  Batch q;
  Batch root;  ///< y^(-1/3), to 2^-40
};

TISSU_INLINE CubeParts cube_parts(Batch magnitude) {
  // m^(-1/3) on [1, 2), to 2^-14.7.
  constexpr double kU[] = {1.6700066897789132, -1.1728800644384498, 0.6954824685999546, -0.22123777217282753,
                           0.02859101031921283};
  const auto tiny = magnitude.v < Batch(0x1p-1022).v;
  const Batch scaled(tiny ? (magnitude * Batch(0x1p54)).v : magnitude.v);
  const Batch exponent = whole(bits_of(scaled) >> 52) - Batch(1023.0);
  const Batch q = ((exponent - Batch(1.0)) * Batch(1.0 / 3.0) + Batch(kRound)) - Batch(kRound);
  const Batch rest = exponent - Batch(3.0) * q;  // 0, 1 or 2
  const auto one = rest.v > Batch(0.5).v;
  const auto two = rest.v > Batch(1.5).v;
  const Batch m = from_bits((bits_of(scaled) & all(kMantissa)) | all(kExponentOne));
  const Batch factor(one ? (two ? Batch(0.6299605249474366).v : Batch(0.7937005259840998).v) : Batch(1.0).v);
  const Batch y = m * Batch(one ? (two ? Batch(4.0).v : Batch(2.0).v) : Batch(1.0).v);
  const Batch u = polynomial(kU, m) * factor;
  const Batch e = Batch(1.0) - y * u * u * u;  // u (1 - e)^(-1/3) is the root
  const Batch root = u + u * e * (Batch(1.0 / 3.0) + e * Batch(2.0 / 9.0));
  return {y, Batch(tiny ? (q - Batch(18.0)).v : q.v), root};
}

TISSU_INLINE Batch magnitude(Batch x) { return from_bits(bits_of(x) & all(~std::uint64_t{0} >> 1)); }
TISSU_INLINE Batch with_sign_of(Batch value, Batch x) {
  return from_bits(bits_of(value) | (bits_of(x) & all(std::uint64_t{1} << 63)));
}

/// Real cube root, of negative numbers too. From t, the first 26 bits of y u^2 (u = y^(-1/3)), one step of
/// second order; t^3 is known exactly, its square being cut in two.
TISSU_INLINE Batch cbrt(Batch x) {
  const Batch a = magnitude(x);
  const CubeParts p = cube_parts(a);
  const Batch square = p.root * p.root;
  const BatchBits upper = all(~std::uint64_t{0} << 27);
  const Batch t = from_bits(bits_of(p.y * square) & upper);
  const Batch tt = t * t;
  const Batch high = from_bits(bits_of(tt) & upper);
  const Batch d = (p.y - high * t) - (tt - high) * t;  // y - t^3
  const Batch step = d * square * Batch(1.0 / 3.0);
  const Batch root = t + (step + step * step * p.root);
  const Batch result = with_sign_of(root * power_of_two(p.q + Batch(kRound)), x);
  const Batch finite(a.v < Batch(kInfinity).v ? result.v : x.v);
  return {a.v > Batch(0.0).v ? finite.v : x.v};
}

/// 1 / cbrt(x) without a division: infinity with the sign of x at 0.
TISSU_INLINE Batch inverse_cbrt(Batch x) {
  const Batch a = magnitude(x);
  const CubeParts p = cube_parts(a);
  const Batch e = Batch(1.0) - p.y * p.root * (p.root * p.root);
  const Batch root = p.root + p.root * e * Batch(1.0 / 3.0);
  const Batch result = with_sign_of(root * power_of_two(Batch(kRound) - p.q), x);
  const Batch not_finite(a.v == Batch(kInfinity).v ? with_sign_of(Batch(0.0), x).v : x.v);
  const Batch finite(a.v < Batch(kInfinity).v ? result.v : not_finite.v);
  return {a.v == Batch(0.0).v ? with_sign_of(Batch(kInfinity), x).v : finite.v};
}

}  // namespace tissu::TISSU_KERNELS
