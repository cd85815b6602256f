#pragma once

/// The rotation that goes with a deformation gradient F, in every lane, for any F: also inverted, flat,
/// pulled into a line or a point. No state, no table; a lane's result does not depend on its neighbours.
///
/// polar: R with the largest tr(R^T F), the proper rotation nearest to F. With q the unit quaternion of R,
/// tr(R^T F) = q . D q with Davenport's symmetric D (4 x 4), so that lambda = tr(R^T F) is D's largest
/// eigenvalue, s1 + s2 + s3 with the smallest singular value of F negative where det F is. It is the largest
/// root of D's characteristic polynomial, reached from above by Halley's iteration,
///   p(x) = (x^2 - |F|^2)^2 - 8 x det F - 4 |cof F|^2,
/// and R follows without an eigenvector (Markley, FOAM, J. Astronaut. Sci. 41(2), 1993):
///   R = ((k + |F|^2) F + lambda cof F - F F^T F) / z,  k = (lambda^2 - |F|^2) / 2,  z = k lambda - det F,
/// z = (s1 + s2)(s2 + s3)(s3 + s1). Where z is small the nearest rotation is about to jump or is not unique;
/// such lanes take the eigenvector of D by Jacobi's rotations.
///
/// frame: the first column of F, the second made orthogonal to it, and their cross product.

#include "tissu/base/batch.h"
#include "tissu/law/tensor.h"

namespace tissu::TISSU_KERNELS {

using Matrix = Tensor2<Batch>;

/// yes where a > b, else no.
TISSU_INLINE Batch choose(Batch a, Batch b, Batch yes, Batch no) { return {a.v > b.v ? yes.v : no.v}; }

/// a > b in every lane.
TISSU_INLINE bool all_above(Batch a, Batch b) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ) == 0xff;
#elif defined(__AVX2__)
  return _mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ)) == 0xf;
#else
  bool all = true;
  for (int lane = 0; lane < kWidth; ++lane) all = all && a.v[lane] > b.v[lane];
  return all;
#endif
}

/// cof F = det F F^-T
TISSU_INLINE Matrix cofactors(const Matrix& F) {
  Matrix C;
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3;
      const int i2 = (i + 2) % 3;
      const int j1 = (j + 1) % 3;
      const int j2 = (j + 2) % 3;
      C(i, j) = F(i1, j1) * F(i2, j2) - F(i1, j2) * F(i2, j1);
    }
  }
  return C;
}

TISSU_INLINE Batch square(const Matrix& A) {
  Batch sum = A(0, 0) * A(0, 0);
  TISSU_UNROLL
  for (int k = 1; k < 9; ++k) sum += A.m[k / 3][k % 3] * A.m[k / 3][k % 3];
  return sum;
}

TISSU_INLINE Batch larger(Batch a, Batch b) { return {a.v > b.v ? a.v : b.v}; }

/// Davenport's matrix of F, diagonalised by Jacobi's rotations.
struct Davenport {
  static constexpr int kSweeps = 7;  ///< two million matrices, of low rank too, were diagonal by then
  Batch D[4][4];
  Batch V[4][4];  ///< eigenvectors, columns

  TISSU_INLINE explicit Davenport(const Matrix& F) {
    const Batch xx = F(0, 0);
    const Batch yy = F(1, 1);
    const Batch zz = F(2, 2);
    const Batch diagonal[4] = {xx + yy + zz, xx - yy - zz, yy - xx - zz, zz - xx - yy};
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) V[i][j] = Batch(i == j ? 1.0 : 0.0);
      D[i][i] = diagonal[i];
    }
    set(0, 1, F(2, 1) - F(1, 2));
    set(0, 2, F(0, 2) - F(2, 0));
    set(0, 3, F(1, 0) - F(0, 1));
    set(1, 2, F(0, 1) + F(1, 0));
    set(1, 3, F(0, 2) + F(2, 0));
    set(2, 3, F(1, 2) + F(2, 1));
  }
  TISSU_INLINE void set(int i, int j, Batch value) { D[i][j] = D[j][i] = value; }

  /// Makes D[p][q] zero.
  TISSU_INLINE void rotate(int p, int q) {
    const Batch zero(0.0);
    const Batch twice = D[p][q] * Batch(2.0);
    const Batch gap = D[q][q] - D[p][p];
    const Batch root = sqrt(gap * gap + twice * twice);
    const Batch below = gap + choose(zero, gap, -root, root);
    const Batch t = choose(root, zero, twice / choose(root, zero, below, Batch(1.0)), zero);
    const Batch c = Batch(1.0) / sqrt(t * t + Batch(1.0));
    const Batch s = t * c;
    for (int k = 0; k < 4; ++k) {
      const Batch kp = D[k][p];
      const Batch kq = D[k][q];
      D[k][p] = c * kp - s * kq;
      D[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 4; ++k) {
      const Batch pk = D[p][k];
      const Batch qk = D[q][k];
      D[p][k] = c * pk - s * qk;
      D[q][k] = s * pk + c * qk;
    }
    set(p, q, zero);
    for (auto& row : V) {
      const Batch kp = row[p];
      const Batch kq = row[q];
      row[p] = c * kp - s * kq;
      row[q] = s * kp + c * kq;
    }
  }
  TISSU_INLINE void diagonalise() {
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (int p = 0; p < 3; ++p) {
        for (int q = p + 1; q < 4; ++q) rotate(p, q);
      }
    }
  }
  /// The rotation of the eigenvector of the largest eigenvalue, the first of equal ones.
  TISSU_INLINE Matrix largest() const {
    Batch value = D[0][0];
    Batch w[4] = {V[0][0], V[1][0], V[2][0], V[3][0]};
    for (int k = 1; k < 4; ++k) {
      for (int i = 0; i < 4; ++i) w[i] = choose(D[k][k], value, V[i][k], w[i]);
      value = larger(D[k][k], value);
    }
    const Batch two = Batch(2.0) / (w[0] * w[0] + w[1] * w[1] + w[2] * w[2] + w[3] * w[3]);
    const Batch one(1.0);
    Matrix R;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      const Batch qi = w[i + 1];
      const Batch qj = w[j + 1];
      const Batch qk = w[k + 1];
      R(i, i) = one - two * (qj * qj + qk * qk);
      R(i, j) = two * (qi * qj - w[0] * qk);
      R(j, i) = two * (qi * qj + w[0] * qk);
    }
    return R;
  }
};

/// By the eigenvector. F is brought to entries of at most 1 first; the rotation of zero is I.
[[gnu::noinline]] inline void polar_by_eigenvector(const Matrix& F, Matrix& R) {
  Batch size(0.0);
  for (int k = 0; k < 9; ++k) size = larger(magnitude(F.m[k / 3][k % 3]), size);
  const Batch tiny(0x1p-1000);
  const Batch scale = choose(size, tiny, Batch(1.0) / choose(size, tiny, size, Batch(1.0)), Batch(0.0));
  Matrix G;
  for (int k = 0; k < 9; ++k) G.m[k / 3][k % 3] = F.m[k / 3][k % 3] * scale;
  Davenport davenport(G);
  davenport.diagonalise();
  R = davenport.largest();
}

/// The largest root of p, from sqrt(3) |F| downwards, and the last of three steps, whose cube is the error.
struct LargestRoot {
  Batch x;
  Batch last;

  TISSU_INLINE LargestRoot(Batch start, Batch norm2, Batch det, Batch cofactor2) : x(start) {
    const Batch two(2.0);
    const Batch four(4.0);
    const Batch eight_det = Batch(8.0) * det;
    const Batch four_c = four * cofactor2;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      const Batch x2 = x * x;
      const Batch d = x2 - norm2;
      const Batch p = d * d - (x * eight_det + four_c);
      const Batch dp = four * x * d - eight_det;
      const Batch half_d2p = two * d + four * x2;  // (12 x^2 - 4 |F|^2) / 2
      last = p * dp / (dp * dp - p * half_d2p);
      x = x - last;
    }
  }
};

/// The rotation nearest to F; `trace` is tr(R^T F).
TISSU_INLINE Matrix polar_rotation(const Matrix& F, Batch& trace) {
  constexpr double kSmall = 1e-2;  ///< of z / |F|^3, 1.54 at rest: R is good to 1e-16 / kSmall and a little
  constexpr double kStep = 1e-5;   ///< of x: what its cube leaves is round-off
  const Matrix C = cofactors(F);
  const Batch norm2 = square(F);
  const Batch norm = sqrt(norm2);
  const Batch det = F(0, 0) * C(0, 0) + F(0, 1) * C(0, 1) + F(0, 2) * C(0, 2);
  const LargestRoot root(norm * Batch(1.7320508075688772), norm2, det, square(C));
  const Batch x = root.x;
  const Batch k = Batch(0.5) * (x * x - norm2);
  const Batch z = k * x - det;
  const Batch inverse = Batch(1.0) / z;
  const Batch of_F = (k + norm2) * inverse;
  const Batch of_C = x * inverse;
  Matrix G = transposed_product(F, F);
  TISSU_UNROLL
  for (int i = 0; i < 9; ++i)
    G.m[i / 3][i % 3] = (i % 4 == 0 ? of_F : Batch(0.0)) - G.m[i / 3][i % 3] * inverse;
  Matrix R;
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) {
      R(i, j) = F(i, 0) * G(0, j) + F(i, 1) * G(1, j) + F(i, 2) * G(2, j) + of_C * C(i, j);
    }
  }
  trace = x;
  // A NaN fails all three; beyond 1e+-30 the sixth powers of the root leave the range of a double.
  const Batch zero(0.0);
  const Batch sized = choose(norm, Batch(1e-30), choose(Batch(1e30), norm, Batch(1.0), zero), zero);
  const Batch settled = choose(Batch(kStep) * x, magnitude(root.last), sized, zero);
  const Batch good = choose(z, Batch(kSmall) * norm2 * norm, settled, zero);
  if (all_above(good, zero)) return R;
  Matrix sure;
  polar_by_eigenvector(F, sure);
  Batch sum(0.0);
  for (int i = 0; i < 9; ++i) {
    Batch& r = R.m[i / 3][i % 3];
    r = choose(good, zero, r, sure.m[i / 3][i % 3]);
    sum += r * F.m[i / 3][i % 3];
  }
  trace = choose(good, zero, trace, sum);
  return R;
}

/// The axes of the first two columns of F. A column that vanishes, or lies along the first, beside F gives
/// way to an axis of space that lies across.
TISSU_INLINE Matrix frame_rotation(const Matrix& F) {
  const Batch least = Batch(1e-20) * square(F);
  Batch a[3] = {F(0, 0), F(1, 0), F(2, 0)};
  const Batch aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  const Batch length = Batch(1.0) / sqrt(choose(aa, least, aa, Batch(1.0)));
  for (int i = 0; i < 3; ++i) a[i] = choose(aa, least, a[i] * length, Batch(i == 0 ? 1.0 : 0.0));
  Batch b[3] = {F(0, 1), F(1, 1), F(2, 1)};
  for (int twice = 0; twice < 2; ++twice) {
    const Batch along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (int i = 0; i < 3; ++i) b[i] -= along * a[i];
  }
  const Batch bb = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
  // x unless a lies along it, then y: made orthogonal to a.
  const Batch share = choose(Batch(0.6), a[0] * a[0], a[0], a[1]);
  Batch c[3];
  for (int i = 0; i < 3; ++i) {
    const Batch axis = choose(Batch(0.6), a[0] * a[0], Batch(i == 0 ? 1.0 : 0.0), Batch(i == 1 ? 1.0 : 0.0));
    c[i] = choose(bb, least, b[i], axis - share * a[i]);
  }
  const Batch inverse = Batch(1.0) / sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
  Matrix R;
  for (int i = 0; i < 3; ++i) {
    R(i, 0) = a[i];
    R(i, 1) = c[i] * inverse;
  }
  R(0, 2) = R(1, 0) * R(2, 1) - R(2, 0) * R(1, 1);
  R(1, 2) = R(2, 0) * R(0, 1) - R(0, 0) * R(2, 1);
  R(2, 2) = R(0, 0) * R(1, 1) - R(1, 0) * R(0, 1);
  return R;
}

}  // namespace tissu::TISSU_KERNELS
