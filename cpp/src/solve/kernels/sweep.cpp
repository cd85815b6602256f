/// A row of a triangular solve is a row of the product (assembly/kernels/product.cpp) that reads what earlier
/// rows wrote.

#include <cstddef>
#include <cstring>

#include "assembly/kernels/four.h"
#include "sweep_list.h"

namespace tissu::TISSU_KERNELS {
namespace {

template <class T>
[[gnu::always_inline]] inline void sweep(const std::int32_t* rows, std::int32_t count,
                                         const std::int64_t* begin, const std::int32_t* column,
                                         const T* values, T* x) {
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t r = rows[i];
    Four<T> sum[3] = {};
    for (std::int64_t s = begin[r]; s < begin[r + 1]; ++s) {
      const T* block = values + 9 * s;
      const T* p = x + 3 * static_cast<std::ptrdiff_t>(column[s]);
      for (int k = 0; k < 3; ++k) {
        Four<T> of_block;
        std::memcpy(&of_block, block + 3 * k, sizeof of_block);
        sum[k] += of_block * p[k];
      }
    }
    const Four<T> total = sum[0] + sum[1] + sum[2];
    T* to = x + 3 * static_cast<std::ptrdiff_t>(r);
    for (int k = 0; k < 3; ++k) to[k] -= total[k];
  }
}

}  // namespace

void sweep_rows(const std::int32_t* rows, std::int32_t count, const std::int64_t* begin,
                const std::int32_t* column, const double* values, double* x) {
  sweep(rows, count, begin, column, values, x);
}

void sweep_rows(const std::int32_t* rows, std::int32_t count, const std::int64_t* begin,
                const std::int32_t* column, const float* values, float* x) {
  sweep(rows, count, begin, column, values, x);
}

}  // namespace tissu::TISSU_KERNELS
