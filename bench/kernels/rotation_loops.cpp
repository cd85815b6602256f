#include "cell/kernels/rotation.h"
#include "loops.h"

namespace tissu::TISSU_KERNELS {
namespace {

/// Of polar_rotation, counted in its source, a root or a quotient as one: cofactors 27, |F|^2 and |cof F|^2
/// 34, |F| and the start 2, det F 5, constants of the root's equation 2, three steps of 18, k, z, 1 / z and
/// two factors 9, F^T F 45, what F is multiplied with 18, R 63, the tests 5.
constexpr double kPolar = 27 + 34 + 2 + 5 + 2 + 3 * 18 + 9 + 45 + 18 + 63 + 5;

template <class Function>
void over(const double* F, std::size_t groups, double* R, Function&& f) {
  for (std::size_t group = 0; group < groups; ++group) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const std::size_t first = group * 9 * kLanes + static_cast<std::size_t>(lane);
      Matrix A;
      TISSU_UNROLL
      for (std::size_t k = 0; k < 9; ++k) A.m[k / 3][k % 3] = Batch::load(F + first + k * kLanes);
      const Matrix B = f(A);
      TISSU_UNROLL
      for (std::size_t k = 0; k < 9; ++k) B.m[k / 3][k % 3].store(R + first + k * kLanes);
    }
  }
}

void polar(const double* F, std::size_t groups, double* R) {
  over(F, groups, R, [](const Matrix& A) {
    Batch trace;
    return polar_rotation(A, trace);
  });
}

void frame(const double* F, std::size_t groups, double* R) {
  over(F, groups, R, [](const Matrix& A) { return frame_rotation(A); });
}

}  // namespace

bench::RotationKernels rotation_loops() {
  return {{{"polar", kPolar, false, &polar},
           {"polar, one in eight flat", 0.0, true, &polar},
           {"frame", 0.0, false, &frame}}};
}

}  // namespace tissu::TISSU_KERNELS
