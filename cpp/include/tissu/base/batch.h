#pragma once

/// A batch of doubles, one per element ("lane"), as wide as the instruction set this file is compiled for.
/// Kernel sources are compiled once for each set, everything inside a namespace named by TISSU_KERNELS, so
/// that code for one set can never be linked in place of another's. No standard library code is called in
/// here.

#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#ifndef TISSU_KERNELS
#define TISSU_KERNELS baseline
#endif
#define TISSU_INLINE [[gnu::always_inline]] inline

namespace tissu::TISSU_KERNELS {

#if defined(__AVX512F__)
inline constexpr int kWidth = 8;
#elif defined(__AVX2__)
inline constexpr int kWidth = 4;
#else
inline constexpr int kWidth = 2;
#endif
inline constexpr int kLanes = 8;  ///< elements stored side by side in memory, the same for every set

struct Batch {
  using Native = double __attribute__((vector_size(kWidth * sizeof(double))));
  Native v;

  Batch() = default;
  TISSU_INLINE Batch(Native value)
      : v(value) {}                 // NOLINT(google-explicit-constructor): a batch is its register
  TISSU_INLINE Batch(double value)  // NOLINT(google-explicit-constructor): a number in every lane
      : v(value - Native{}) {}
  TISSU_INLINE static Batch load(const double* values) {
    Batch b;
    std::memcpy(&b.v, values, sizeof(Native));
    return b;
  }
  TISSU_INLINE void store(double* values) const { std::memcpy(values, &v, sizeof(Native)); }
  TISSU_INLINE double operator[](int lane) const { return v[lane]; }

  TISSU_INLINE friend Batch operator+(Batch a, Batch b) { return {a.v + b.v}; }
  TISSU_INLINE friend Batch operator-(Batch a, Batch b) { return {a.v - b.v}; }
  TISSU_INLINE friend Batch operator*(Batch a, Batch b) { return {a.v * b.v}; }
  TISSU_INLINE friend Batch operator/(Batch a, Batch b) { return {a.v / b.v}; }
  TISSU_INLINE friend Batch operator-(Batch a) { return {-a.v}; }
  TISSU_INLINE Batch& operator+=(Batch b) {
    v += b.v;
    return *this;
  }
  TISSU_INLINE Batch& operator-=(Batch b) {
    v -= b.v;
    return *this;
  }
};

/// Square root in every lane.
TISSU_INLINE Batch sqrt(Batch a) {
  for (int lane = 0; lane < kWidth; ++lane) a.v[lane] = __builtin_sqrt(a.v[lane]);
  return a;
}

/// max(a, 0) in every lane.
TISSU_INLINE Batch positive(Batch a) { return {a.v > Batch::Native{} ? a.v : Batch::Native{}}; }

/// 1 where a > 0, else 0.
TISSU_INLINE Batch step(Batch a) { return {a.v > Batch::Native{} ? Batch(1.0).v : Batch::Native{}}; }

TISSU_INLINE const double* at(const double* values, std::int32_t i, int size) {
  return values + static_cast<std::ptrdiff_t>(i) * size;
}
TISSU_INLINE double* at(double* values, std::int32_t i, int size) {
  return values + static_cast<std::ptrdiff_t>(i) * size;
}

#if defined(__AVX2__)

TISSU_INLINE void add_at(double* to, __m256d value) {
  _mm256_storeu_pd(to, _mm256_add_pd(_mm256_loadu_pd(to), value));
}

/// Adds entries `first` to `first`+3 of four blocks of nine.
TISSU_INLINE void scatter_quarter(double* values, const std::int32_t* slot, int first, __m256d a, __m256d b,
                                  __m256d c, __m256d d) {
  const __m256d ab_lo = _mm256_unpacklo_pd(a, b);
  const __m256d ab_hi = _mm256_unpackhi_pd(a, b);
  const __m256d cd_lo = _mm256_unpacklo_pd(c, d);
  const __m256d cd_hi = _mm256_unpackhi_pd(c, d);
  add_at(at(values, slot[0], 9) + first, _mm256_permute2f128_pd(ab_lo, cd_lo, 0x20));
  add_at(at(values, slot[1], 9) + first, _mm256_permute2f128_pd(ab_hi, cd_hi, 0x20));
  add_at(at(values, slot[2], 9) + first, _mm256_permute2f128_pd(ab_lo, cd_lo, 0x31));
  add_at(at(values, slot[3], 9) + first, _mm256_permute2f128_pd(ab_hi, cd_hi, 0x31));
}

TISSU_INLINE void scatter_nine(double* values, const std::int32_t* slot, const __m256d (&b)[9]) {
  scatter_quarter(values, slot, 0, b[0], b[1], b[2], b[3]);
  scatter_quarter(values, slot, 4, b[4], b[5], b[6], b[7]);
  for (int lane = 0; lane < 4; ++lane) at(values, slot[lane], 9)[8] += b[8][lane];
}

#endif

/// Adds a block of nine numbers to one block for each lane.
TISSU_INLINE void scatter_add_block(double* values, const std::int32_t* slot, const Batch (&in)[9]) {
#if defined(__AVX512F__)
  __m256d part[9];
  for (int i = 0; i < 9; ++i) part[i] = _mm512_castpd512_pd256(in[i].v);
  scatter_nine(values, slot, part);
  for (int i = 0; i < 9; ++i) part[i] = _mm512_extractf64x4_pd(in[i].v, 1);
  scatter_nine(values, slot + 4, part);
#elif defined(__AVX2__)
  __m256d part[9];
  for (int i = 0; i < 9; ++i) part[i] = in[i].v;
  scatter_nine(values, slot, part);
#else
  for (int lane = 0; lane < kWidth; ++lane) {
    for (int i = 0; i < 9; ++i) at(values, slot[lane], 9)[i] += in[i].v[lane];
  }
#endif
}

}  // namespace tissu::TISSU_KERNELS

#include "tissu/base/batch_math.h"  // IWYU pragma: export: log, exp, cbrt
