#pragma once

/// The product of rows of a block matrix, for each instruction set, in double and in single precision.

#include <cstdint>

#include "tissu/base/isa.h"

namespace tissu {

template <class T>
using MultiplyRows = void (*)(const std::int64_t* row_begin, const std::int64_t* row_end,
                              const std::int32_t* column, const T* values, std::int32_t begin,
                              std::int32_t end, const T* p, T* out);

/// The products of three vectors in one reading of the matrix.
using MultiplyThree = void (*)(const std::int64_t* row_begin, const std::int64_t* row_end,
                               const std::int32_t* column, const double* values, std::int32_t begin,
                               std::int32_t end, const double* const* p, double* const* out);

#define TISSU_PRODUCT(isa)                                                                                   \
  namespace isa {                                                                                            \
  void multiply_rows(const std::int64_t* row_begin, const std::int64_t* row_end, const std::int32_t* column, \
                     const double* values, std::int32_t begin, std::int32_t end, const double* p,            \
                     double* out);                                                                           \
  void multiply_rows(const std::int64_t* row_begin, const std::int64_t* row_end, const std::int32_t* column, \
                     const float* values, std::int32_t begin, std::int32_t end, const float* p, float* out); \
  void multiply_three(const std::int64_t* row_begin, const std::int64_t* row_end,                            \
                      const std::int32_t* column, const double* values, std::int32_t begin,                  \
                      std::int32_t end, const double* const* p, double* const* out);                         \
  }
TISSU_PRODUCT(baseline)
TISSU_PRODUCT(avx2)
TISSU_PRODUCT(avx512)
#undef TISSU_PRODUCT

template <class T>
MultiplyRows<T> multiply_rows_of(Isa isa);
MultiplyThree multiply_three_of(Isa isa);

}  // namespace tissu
