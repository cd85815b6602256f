/// out = A p for rows of 3x3 blocks. A block is stored column by column, so a row of blocks is a sum of
/// columns times numbers of p: one load, one broadcast and one fused multiply-add for each column, and
/// nothing of the block is shuffled. The fourth lane reads the next column's first number and is dropped at
/// the end.

#include <cstddef>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "four.h"
#include "product_list.h"

namespace tissu::TISSU_KERNELS {
namespace {

template <class T>
[[gnu::always_inline]] inline void add_block(const T* block, const T* p, Four<T> (&sum)[3]) {
  for (int k = 0; k < 3; ++k) {
    Four<T> column;
    std::memcpy(&column, block + 3 * k, sizeof column);
    sum[k] += column * p[k];
  }
}

#if defined(__SSE2__)
/// Loads are what bounds a product that a cache holds: two numbers of p in one of them leave five of six. The
/// compiler would make them two again, of a plain load. Registers of four in double precision would have to
/// cross their halves, which costs more.
template <>
[[gnu::always_inline]] inline void add_block(const float* block, const float* p, Four<float> (&sum)[3]) {
  const __m128 two = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  const Four<float> factor[3] = {_mm_shuffle_ps(two, two, 0x00), _mm_shuffle_ps(two, two, 0x55),
                                 _mm_set1_ps(p[2])};
  for (int k = 0; k < 3; ++k) {
    Four<float> column;
    std::memcpy(&column, block + 3 * k, sizeof column);
    sum[k] += column * factor[k];
  }
}
#endif

template <class T>
[[gnu::always_inline]] inline void multiply(const std::int64_t* row_begin, const std::int64_t* row_end,
                                            const std::int32_t* column, const T* values, std::int32_t begin,
                                            std::int32_t end, const T* p, T* out) {
  using V = Four<T>;
  for (std::int32_t r = begin; r < end; ++r) {
    V even[3] = {V{}, V{}, V{}};
    V odd[3] = {V{}, V{}, V{}};
    std::int64_t s = row_begin[r];
    const std::int64_t last = row_end[r];
    for (; s + 1 < last; s += 2) {
      add_block<T>(values + 9 * s, p + 3 * static_cast<std::ptrdiff_t>(column[s]), even);
      add_block<T>(values + 9 * s + 9, p + 3 * static_cast<std::ptrdiff_t>(column[s + 1]), odd);
    }
    if (s < last) add_block<T>(values + 9 * s, p + 3 * static_cast<std::ptrdiff_t>(column[s]), even);
    const V sum = (even[0] + odd[0]) + (even[1] + odd[1]) + (even[2] + odd[2]);
    T* to = out + 3 * static_cast<std::ptrdiff_t>(r);
    to[0] = sum[0];
    to[1] = sum[1];
    to[2] = sum[2];
  }
}

}  // namespace

void multiply_three(const std::int64_t* row_begin, const std::int64_t* row_end, const std::int32_t* column,
                    const double* values, std::int32_t begin, std::int32_t end, const double* const* p,
                    double* const* out) {
  for (std::int32_t r = begin; r < end; ++r) {
    FourDoubles sum[3][3] = {};
    for (std::int64_t s = row_begin[r]; s < row_end[r]; ++s) {
      const double* block = values + 9 * s;
      const std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(column[s]);
      for (int k = 0; k < 3; ++k) {
        FourDoubles of_block;
        std::memcpy(&of_block, block + 3 * k, sizeof of_block);
        for (int v = 0; v < 3; ++v) sum[v][k] += of_block * p[v][at + k];
      }
    }
    for (int v = 0; v < 3; ++v) {
      const FourDoubles total = sum[v][0] + sum[v][1] + sum[v][2];
      double* to = out[v] + 3 * static_cast<std::ptrdiff_t>(r);
      for (int k = 0; k < 3; ++k) to[k] = total[k];
    }
  }
}

void multiply_rows(const std::int64_t* row_begin, const std::int64_t* row_end, const std::int32_t* column,
                   const double* values, std::int32_t begin, std::int32_t end, const double* p, double* out) {
  multiply(row_begin, row_end, column, values, begin, end, p, out);
}

void multiply_rows(const std::int64_t* row_begin, const std::int64_t* row_end, const std::int32_t* column,
                   const float* values, std::int32_t begin, std::int32_t end, const float* p, float* out) {
  multiply(row_begin, row_end, column, values, begin, end, p, out);
}

}  // namespace tissu::TISSU_KERNELS
