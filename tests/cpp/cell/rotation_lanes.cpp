#include "rotation_lanes.h"

#include "cell/kernels/rotation.h"

namespace tissu::TISSU_KERNELS {
namespace {

template <class Function>
void over(const double* F, double* R, std::size_t count, Function&& f) {
  for (std::size_t i = 0; i < count; i += kWidth) {
    Matrix A;
    for (std::size_t k = 0; k < 9; ++k) A.m[k / 3][k % 3] = Batch::load(F + k * count + i);
    const Matrix B = f(A);
    for (std::size_t k = 0; k < 9; ++k) B.m[k / 3][k % 3].store(R + k * count + i);
  }
}

void polar(const double* F, double* R, std::size_t count) {
  over(F, R, count, [](const Matrix& A) {
    Batch trace;
    return polar_rotation(A, trace);
  });
}
void by_eigenvector(const double* F, double* R, std::size_t count) {
  over(F, R, count, [](const Matrix& A) {
    Matrix B;
    polar_by_eigenvector(A, B);
    return B;
  });
}
void frame(const double* F, double* R, std::size_t count) {
  over(F, R, count, [](const Matrix& A) { return frame_rotation(A); });
}

}  // namespace

test::Rotations rotations() { return {&polar, &by_eigenvector, &frame}; }

}  // namespace tissu::TISSU_KERNELS
