#pragma once

/// The product of rows of a block matrix, for each instruction set.

#include <cstdint>

namespace tissu {

#define TISSU_PRODUCT(isa)                                                                            \
  namespace isa {                                                                                     \
  void multiply_rows(const std::int64_t* row_begin, const std::int32_t* column, const double* values, \
                     std::int32_t begin, std::int32_t end, const double* p, double* out);             \
  }
TISSU_PRODUCT(baseline)
TISSU_PRODUCT(avx2)
TISSU_PRODUCT(avx512)
#undef TISSU_PRODUCT

}  // namespace tissu
