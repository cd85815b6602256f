#pragma once

/// How the rotation R of a cell follows its nodes. R keeps three entries of A = R^T F at zero,
///   l(A) = (A_zy - t A_yz, t A_xz - A_zx, A_yx - t A_xy):
/// t = 1 makes A symmetric, R that of the polar decomposition; t = 0 makes it triangular, R that of the
/// frame. When F changes by R B, R changes by R [w] with l(B - [w] A) = 0, so that D w = l(B), D w = l([w]
/// A).

#include "cell/kernels/rotation.h"

namespace tissu::TISSU_KERNELS {

struct Spin {
  /// Of det D, 8 at rest: where a cell is squeezed so flat that a touch would turn R by far, w is kept from
  /// growing beyond all bounds, and is no longer exact.
  static constexpr double kLeast = 1e-2;

  Batch both;      ///< t
  Matrix inverse;  ///< D^-1

  TISSU_INLINE Spin(const Matrix& A, bool polar) : both(polar ? 1.0 : 0.0) {
    const Matrix D = {{{A(1, 1) + both * A(2, 2), -A(0, 1), -both * A(0, 2)},
                       {-A(1, 0), A(0, 0) + both * A(2, 2), -both * A(1, 2)},
                       {-A(2, 0), -both * A(2, 1), A(0, 0) + both * A(1, 1)}}};
    const Matrix C = cofactors(D);
    const Batch det = D(0, 0) * C(0, 0) + D(0, 1) * C(0, 1) + D(0, 2) * C(0, 2);
    const Batch share = Batch(1.0) / larger(det, Batch(kLeast));
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) inverse(i, j) = C(j, i) * share;
    }
  }

  /// w of a change B.
  TISSU_INLINE void of(const Matrix& B, Batch (&w)[3]) const {
    const Batch l[3] = {B(2, 1) - both * B(1, 2), both * B(0, 2) - B(2, 0), B(1, 0) - both * B(0, 1)};
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) w[i] = inverse(i, 0) * l[0] + inverse(i, 1) * l[1] + inverse(i, 2) * l[2];
  }
  /// k = D^-T t, so that t . w = k . l(B)
  TISSU_INLINE void transposed(const Batch (&t)[3], Batch (&k)[3]) const {
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) k[i] = inverse(0, i) * t[0] + inverse(1, i) * t[1] + inverse(2, i) * t[2];
  }
  /// s P with P : B = k . l(B)
  TISSU_INLINE Matrix stress(const Batch (&k)[3], Batch s) const {
    const Batch t = s * both;
    const Batch zero(0.0);
    return {{{zero, -t * k[2], t * k[1]}, {s * k[2], zero, -t * k[0]}, {-s * k[1], s * k[0], zero}}};
  }
  /// U with w = sum_a U_a q_a where B = sum_a q_a (x) g_a
  TISSU_INLINE Matrix of_node(const Batch (&g)[3]) const {
    const Batch zero(0.0);
    const Matrix l = {{{zero, -both * g[2], g[1]}, {both * g[2], zero, -g[0]}, {-both * g[1], g[0], zero}}};
    return product(inverse, l);
  }
  /// y += s (dD)^T k of a change of A
  TISSU_INLINE void add_change(const Matrix& dA, const Batch (&k)[3], double s, Batch (&y)[3]) const {
    const Batch scale(s);
    y[0] += scale * ((dA(1, 1) + both * dA(2, 2)) * k[0] - dA(1, 0) * k[1] - dA(2, 0) * k[2]);
    y[1] += scale * ((dA(0, 0) + both * dA(2, 2)) * k[1] - dA(0, 1) * k[0] - both * dA(2, 1) * k[2]);
    y[2] += scale * ((dA(0, 0) + both * dA(1, 1)) * k[2] - both * (dA(0, 2) * k[0] + dA(1, 2) * k[1]));
  }
};

}  // namespace tissu::TISSU_KERNELS
