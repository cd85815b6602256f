#pragma once

/// Rows of triangular solves with 3x3 blocks, for each instruction set.

#include <cstdint>

#include "tissu/base/isa.h"

namespace tissu {

/// x_r -= sum_s B_s x_c(s) for the rows r listed, one after the other; B column by column, one number
/// readable behind the last block.
template <class T>
using SweepRows = void (*)(const std::int32_t* rows, std::int32_t count, const std::int64_t* begin,
                           const std::int32_t* column, const T* values, T* x);

#define TISSU_SWEEP(isa)                                                                   \
  namespace isa {                                                                          \
  void sweep_rows(const std::int32_t* rows, std::int32_t count, const std::int64_t* begin, \
                  const std::int32_t* column, const double* values, double* x);            \
  void sweep_rows(const std::int32_t* rows, std::int32_t count, const std::int64_t* begin, \
                  const std::int32_t* column, const float* values, float* x);              \
  }
TISSU_SWEEP(baseline)
TISSU_SWEEP(avx2)
TISSU_SWEEP(avx512)
#undef TISSU_SWEEP

template <class T>
SweepRows<T> sweep_rows_of(Isa isa);

}  // namespace tissu
