#pragma once

/// The functions of rotation.h over arrays of matrices, as each instruction set has them.

#include <cstddef>

namespace tissu::test {

struct Rotations {
  /// F and R are [entry, row after row][count]; `count` is a multiple of eight.
  using Function = void (*)(const double* F, double* R, std::size_t count);
  Function polar;
  Function by_eigenvector;
  Function frame;
};

}  // namespace tissu::test

#define TISSU_ROTATIONS(isa)   \
  namespace tissu::isa {       \
  test::Rotations rotations(); \
  }
TISSU_ROTATIONS(baseline)
TISSU_ROTATIONS(avx2)
TISSU_ROTATIONS(avx512)
#undef TISSU_ROTATIONS
