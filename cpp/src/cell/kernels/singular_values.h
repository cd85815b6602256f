#pragma once

/// F = U diag(s) V^T in every lane, with U and V rotations, for any F: also inverted, flat, pulled into a
/// line or a point. s[0] >= s[1] >= |s[2]|; only s[2] may be negative, as det F then is.
///
/// One-sided Jacobi (Hestenes, J. SIAM 6, 1958): V turns the columns of B = F V until they are orthogonal, so
/// that small singular values come out as exactly as large ones; F^T F would lose half their digits. A column
/// that vanishes beside F has no direction and is given one across the others. A lane's result does not
/// depend on its neighbours.

#include "rotation.h"

namespace tissu::TISSU_KERNELS {

struct SingularValues {
  static constexpr int kSweeps = 12;       ///< four or five are enough; NaN takes all
  static constexpr double kCross = 1e-30;  ///< of |b_p|^2 |b_q|^2: (b_p . b_q)^2 that counts as none

  Matrix U;
  Matrix V;
  Batch s[3];

  TISSU_INLINE explicit SingularValues(const Matrix& F) {
    Batch size(0.0);
    for (int k = 0; k < 9; ++k) size = larger(magnitude(F.m[k / 3][k % 3]), size);
    const Batch tiny(0x1p-1000);
    const Batch scale = Batch(1.0) / choose(size, tiny, size, Batch(1.0));
    Matrix B;
    for (int k = 0; k < 9; ++k) {
      B.m[k / 3][k % 3] = F.m[k / 3][k % 3] * scale;
      V.m[k / 3][k % 3] = Batch(k % 4 == 0 ? 1.0 : 0.0);
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      const bool first = turn(B, 0, 1);
      const bool second = turn(B, 0, 2);
      const bool third = turn(B, 1, 2);
      if (!first && !second && !third) break;
    }
    sort(B, 0, 1);
    sort(B, 0, 2);
    sort(B, 1, 2);
    find_left(B);
    for (int k = 0; k < 3; ++k) {
      s[k] = (U(0, k) * B(0, k) + U(1, k) * B(1, k) + U(2, k) * B(2, k)) / scale;
    }
  }

 private:
  TISSU_INLINE static Batch columns(const Matrix& B, int p, int q) {
    return B(0, p) * B(0, q) + B(1, p) * B(1, q) + B(2, p) * B(2, q);
  }
  TISSU_INLINE static void turn_columns(Matrix& B, int p, int q, Batch c, Batch s) {
    for (int i = 0; i < 3; ++i) {
      const Batch bp = B(i, p);
      const Batch bq = B(i, q);
      B(i, p) = c * bp - s * bq;
      B(i, q) = s * bp + c * bq;
    }
  }
  /// Makes columns p and q orthogonal in the lanes where they are not; false where they are in all.
  TISSU_INLINE bool turn(Matrix& B, int p, int q) {
    const Batch zero(0.0);
    const Batch pp = columns(B, p, p);
    const Batch qq = columns(B, q, q);
    const Batch pq = columns(B, p, q);
    const Batch none = Batch(kCross) * pp * qq + Batch(0x1p-1020);
    if (all_above(none, pq * pq)) return false;
    const Batch twice = pq * Batch(2.0);
    const Batch gap = qq - pp;
    const Batch root = sqrt(gap * gap + twice * twice);
    const Batch below = gap + choose(zero, gap, -root, root);
    const Batch turned = choose(root, zero, twice / choose(root, zero, below, Batch(1.0)), zero);
    const Batch t = choose(none, pq * pq, zero, turned);
    const Batch c = Batch(1.0) / sqrt(t * t + Batch(1.0));
    turn_columns(B, p, q, c, t * c);
    turn_columns(V, p, q, c, t * c);
    return true;
  }
  /// A quarter turn where column q is the longer.
  TISSU_INLINE void sort(Matrix& B, int p, int q) {
    const Batch pp = columns(B, p, p);
    const Batch qq = columns(B, q, q);
    const Batch s = choose(qq, pp, Batch(-1.0), Batch(0.0));
    const Batch c = choose(qq, pp, Batch(0.0), Batch(1.0));
    turn_columns(B, p, q, c, s);
    turn_columns(V, p, q, c, s);
  }
  /// U of the directions of B's columns, the third across the others.
  TISSU_INLINE void find_left(const Matrix& B) {
    const Batch least(1e-200);
    const Batch aa = columns(B, 0, 0);
    const Batch of_a = Batch(1.0) / sqrt(choose(aa, least, aa, Batch(1.0)));
    Batch a[3];
    for (int i = 0; i < 3; ++i) a[i] = choose(aa, least, B(i, 0) * of_a, Batch(i == 0 ? 1.0 : 0.0));
    // Where b vanishes: the part across a of x, or of y if a lies along x.
    const Batch share = choose(Batch(0.6), a[0] * a[0], a[0], a[1]);
    const Batch bb = columns(B, 1, 1);
    const Batch along = a[0] * B(0, 1) + a[1] * B(1, 1) + a[2] * B(2, 1);
    Batch b[3];
    for (int i = 0; i < 3; ++i) {
      const Batch axis =
          choose(Batch(0.6), a[0] * a[0], Batch(i == 0 ? 1.0 : 0.0), Batch(i == 1 ? 1.0 : 0.0));
      b[i] = choose(bb, least, B(i, 1) - along * a[i], axis - share * a[i]);
    }
    const Batch of_b = Batch(1.0) / sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    for (int i = 0; i < 3; ++i) {
      U(i, 0) = a[i];
      U(i, 1) = b[i] * of_b;
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      U(i, 2) = U(j, 0) * U(k, 1) - U(k, 0) * U(j, 1);
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
