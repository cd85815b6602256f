#include "projection_lanes.h"

#include "cell/kernels/semidefinite.h"
#include "cell/kernels/singular_values.h"

namespace tissu::TISSU_KERNELS {
namespace {

void singular_values(const double* F, double* U, double* s, double* V, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    Matrix A;
    for (std::size_t k = 0; k < 9; ++k) A.m[k / 3][k % 3] = Batch::load(F + k * count + i);
    const SingularValues of(A);
    for (std::size_t k = 0; k < 9; ++k) {
      of.U.m[k / 3][k % 3].store(U + k * count + i);
      of.V.m[k / 3][k % 3].store(V + k * count + i);
    }
    for (std::size_t k = 0; k < 3; ++k) of.s[k].store(s + k * count + i);
  }
}

template <int n>
void semidefinite(double* A, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    Batch M[n][n];
    for (std::size_t k = 0; k < n * n; ++k) M[k / n][k % n] = Batch::load(A + k * count + i);
    make_semidefinite(M);
    for (std::size_t k = 0; k < n * n; ++k) M[k / n][k % n].store(A + k * count + i);
  }
}

}  // namespace

test::Projections projections() {
  return {&singular_values, {&semidefinite<3>, &semidefinite<6>, &semidefinite<9>, &semidefinite<24>}};
}

}  // namespace tissu::TISSU_KERNELS
