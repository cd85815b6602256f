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

/// The 3-vectors of four nodes, two numbers a load, turned into one register for each axis.
TISSU_INLINE void gather_four(const double* values, const std::int32_t* node, __m256d& x, __m256d& y,
                              __m256d& z) {
  const double* a = at(values, node[0], 3);
  const double* b = at(values, node[1], 3);
  const double* c = at(values, node[2], 3);
  const double* d = at(values, node[3], 3);
  const __m256d xy02 = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(a)), _mm_loadu_pd(c), 1);
  const __m256d xy13 = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(b)), _mm_loadu_pd(d), 1);
  x = _mm256_unpacklo_pd(xy02, xy13);
  y = _mm256_unpackhi_pd(xy02, xy13);
  const __m128d z01 = _mm_loadh_pd(_mm_load_sd(a + 2), b + 2);
  const __m128d z23 = _mm_loadh_pd(_mm_load_sd(c + 2), d + 2);
  z = _mm256_insertf128_pd(_mm256_castpd128_pd256(z01), z23, 1);
}

TISSU_INLINE void add_three(double* to, __m128d xy, __m128d z) {
  _mm_storeu_pd(to, _mm_add_pd(_mm_loadu_pd(to), xy));
  _mm_store_sd(to + 2, _mm_add_sd(_mm_load_sd(to + 2), z));
}

/// Adds four 3-vectors to four nodes, one lane after the other, so that lanes may share a node.
TISSU_INLINE void scatter_four(double* values, const std::int32_t* node, __m256d x, __m256d y, __m256d z) {
  const __m256d xy02 = _mm256_unpacklo_pd(x, y);
  const __m256d xy13 = _mm256_unpackhi_pd(x, y);
  const __m128d z01 = _mm256_castpd256_pd128(z);
  const __m128d z23 = _mm256_extractf128_pd(z, 1);
  add_three(at(values, node[0], 3), _mm256_castpd256_pd128(xy02), z01);
  add_three(at(values, node[1], 3), _mm256_castpd256_pd128(xy13), _mm_unpackhi_pd(z01, z01));
  add_three(at(values, node[2], 3), _mm256_extractf128_pd(xy02, 1), z23);
  add_three(at(values, node[3], 3), _mm256_extractf128_pd(xy13, 1), _mm_unpackhi_pd(z23, z23));
}

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

/// x, y and z of one node for each lane.
TISSU_INLINE void gather(const double* values, const std::int32_t* node, Batch (&out)[3]) {
#if defined(__AVX512F__)
  __m256d lo[3];
  __m256d hi[3];
  gather_four(values, node, lo[0], lo[1], lo[2]);
  gather_four(values, node + 4, hi[0], hi[1], hi[2]);
  for (int i = 0; i < 3; ++i) out[i].v = _mm512_insertf64x4(_mm512_castpd256_pd512(lo[i]), hi[i], 1);
#elif defined(__AVX2__)
  gather_four(values, node, out[0].v, out[1].v, out[2].v);
#else
  static_assert(kWidth == 2);
  const double* a = at(values, node[0], 3);
  const double* b = at(values, node[1], 3);
  for (int i = 0; i < 3; ++i) out[i].v = Batch::Native{a[i], b[i]};
#endif
}

/// Adds a 3-vector to one node for each lane.
TISSU_INLINE void scatter_add(double* values, const std::int32_t* node, const Batch (&in)[3]) {
#if defined(__AVX512F__)
  scatter_four(values, node, _mm512_castpd512_pd256(in[0].v), _mm512_castpd512_pd256(in[1].v),
               _mm512_castpd512_pd256(in[2].v));
  scatter_four(values, node + 4, _mm512_extractf64x4_pd(in[0].v, 1), _mm512_extractf64x4_pd(in[1].v, 1),
               _mm512_extractf64x4_pd(in[2].v, 1));
#elif defined(__AVX2__)
  scatter_four(values, node, in[0].v, in[1].v, in[2].v);
#else
  for (int lane = 0; lane < kWidth; ++lane) {
    for (int i = 0; i < 3; ++i) at(values, node[lane], 3)[i] += in[i].v[lane];
  }
#endif
}

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
