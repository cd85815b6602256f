#pragma once

/// The functions of singular_values.h and semidefinite.h over arrays of matrices, as each instruction set has
/// them.

#include <cstddef>

namespace tissu::test {

struct Projections {
  /// F, U and V are [entry, row after row][count], s is [3][count]; `count` is a multiple of eight.
  void (*singular_values)(const double* F, double* U, double* s, double* V, std::size_t count);
  /// In place, [entry, row after row][count], of 3, 6, 9 and 24 rows.
  using Function = void (*)(double* A, std::size_t count);
  Function semidefinite[4];
};

}  // namespace tissu::test

#define TISSU_PROJECTIONS(isa)     \
  namespace tissu::isa {           \
  test::Projections projections(); \
  }
TISSU_PROJECTIONS(baseline)
TISSU_PROJECTIONS(avx2)
TISSU_PROJECTIONS(avx512)
#undef TISSU_PROJECTIONS
