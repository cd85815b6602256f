#pragma once

/// The functions of batch_math.h over arrays, as each instruction set has them.

#include <cstddef>

namespace tissu::test {

struct BatchMath {
  /// y_i = f(x_i); `count` is a multiple of eight.
  using Function = void (*)(const double* x, double* y, std::size_t count);
  Function log;
  Function exp;
  Function cbrt;
  Function inverse_cbrt;
};

}  // namespace tissu::test

#define TISSU_BATCH_MATH(isa)   \
  namespace tissu::isa {        \
  test::BatchMath batch_math(); \
  }
TISSU_BATCH_MATH(baseline)
TISSU_BATCH_MATH(avx2)
TISSU_BATCH_MATH(avx512)
#undef TISSU_BATCH_MATH
