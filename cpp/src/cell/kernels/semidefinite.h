#pragma once

/// The positive semi-definite matrix nearest, in Frobenius' norm, to a symmetric one: negative eigenvalues
/// give way to zero (Higham, Linear Algebra Appl. 103, 1988). Cholesky's factors tell first whether there are
/// any; lanes without keep their numbers bit for bit. The eigenvectors are found by Jacobi's rotations, in
/// every lane, on the stack.

#include "rotation.h"

namespace tissu::TISSU_KERNELS {

/// max(a, 0), and NaN where a is.
TISSU_INLINE Batch not_negative(Batch a) { return choose(Batch(0.0), a, Batch(0.0), a); }

/// 1 in the lanes where A, both triangles of it given, has no eigenvalue below round-off, else 0.
template <int n>
TISSU_INLINE Batch is_semidefinite(const Batch (&A)[n][n]) {
  constexpr double kRoundOff = 1e-13;  ///< of the largest entry of the diagonal; n times that of a sum
  Batch largest(0.0);
  for (int i = 0; i < n; ++i) largest = larger(A[i][i], largest);
  const Batch shift = Batch(kRoundOff) * largest + Batch(0x1p-1000);
  Batch L[n][n];
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) L[i][j] = A[i][j];
    L[i][i] += shift;
  }
  Batch yes(1.0);
  for (int k = 0; k < n; ++k) {
    yes = choose(L[k][k], Batch(0.0), yes, Batch(0.0));
    const Batch inverse = Batch(1.0) / L[k][k];
    for (int i = k + 1; i < n; ++i) {
      const Batch share = L[i][k] * inverse;
      for (int j = k + 1; j <= i; ++j) L[i][j] -= share * L[j][k];
    }
  }
  return yes;
}

/// A symmetric matrix that Jacobi's rotations turn to its diagonal.
template <int n>
struct Spectrum {
  static constexpr int kSweeps = 20;      ///< six to nine are enough; NaN takes all
  static constexpr double kNone = 1e-32;  ///< of |A|^2: the square of an entry that counts as zero

  Batch A[n][n];
  Batch vectors[n][n];  ///< rows
  Batch none;

  TISSU_INLINE explicit Spectrum(const Batch (&of)[n][n]) {
    Batch sum(0.0);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        A[i][j] = of[i][j];
        vectors[i][j] = Batch(i == j ? 1.0 : 0.0);
        sum += A[i][j] * A[i][j];
      }
    }
    none = Batch(kNone) * sum + Batch(0x1p-1020);
  }
  /// Makes A[p][q] zero in the lanes where it is not.
  TISSU_INLINE void rotate(int p, int q) {
    const Batch zero(0.0);
    const Batch pq = A[p][q];
    const Batch twice = pq * Batch(2.0);
    const Batch gap = A[q][q] - A[p][p];
    const Batch root = sqrt(gap * gap + twice * twice);
    const Batch below = gap + choose(zero, gap, -root, root);
    const Batch turned = choose(root, zero, twice / choose(root, zero, below, Batch(1.0)), zero);
    const Batch t = choose(none, pq * pq, zero, turned);
    const Batch c = Batch(1.0) / sqrt(t * t + Batch(1.0));
    const Batch s = t * c;
    A[p][p] -= t * pq;
    A[q][q] += t * pq;
    A[p][q] = A[q][p] = choose(none, pq * pq, pq, zero);
    for (int k = 0; k < n; ++k) {
      const Batch vp = vectors[p][k];
      const Batch vq = vectors[q][k];
      vectors[p][k] = c * vp - s * vq;
      vectors[q][k] = s * vp + c * vq;
      if (k == p || k == q) continue;
      const Batch kp = A[p][k];
      const Batch kq = A[q][k];
      A[p][k] = A[k][p] = c * kp - s * kq;
      A[q][k] = A[k][q] = s * kp + c * kq;
    }
  }
  TISSU_INLINE void diagonalise() {
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      bool turned = false;
      for (int p = 0; p < n - 1; ++p) {
        for (int q = p + 1; q < n; ++q) {
          if (all_above(none, A[p][q] * A[p][q])) continue;
          rotate(p, q);
          turned = true;
        }
      }
      if (!turned) return;
    }
  }
};

/// Gives 1 in the lanes that kept their numbers, else 0.
template <int n>
[[gnu::noinline]] Batch make_semidefinite(Batch (&A)[n][n]) {
  const Batch kept = is_semidefinite(A);
  if (all_above(kept, Batch(0.0))) return kept;
  Spectrum<n> spectrum(A);
  spectrum.diagonalise();
  Batch value[n];
  for (int k = 0; k < n; ++k) value[k] = not_negative(spectrum.A[k][k]);
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) {
      Batch sum(0.0);
      for (int k = 0; k < n; ++k) sum += value[k] * spectrum.vectors[k][i] * spectrum.vectors[k][j];
      A[i][j] = A[j][i] = choose(kept, Batch(0.0), A[i][j], sum);
    }
  }
  return kept;
}

/// The same for the matrix of a cell of kNodes nodes, given as its blocks a <= b, [b (b + 1) / 2 + a], each
/// column by column.
template <int kNodes>
[[gnu::noinline]] void make_cell_semidefinite(Batch (&K)[kNodes * (kNodes + 1) / 2][9]) {
  constexpr int n = 3 * kNodes;
  Batch A[n][n];
  for (int b = 0, pair = 0; b < kNodes; ++b) {
    for (int a = 0; a <= b; ++a, ++pair) {
      for (int c = 0; c < 9; ++c)
        A[3 * a + c % 3][3 * b + c / 3] = A[3 * b + c / 3][3 * a + c % 3] = K[pair][c];
    }
  }
  if (all_above(make_semidefinite(A), Batch(0.0))) return;
  for (int b = 0, pair = 0; b < kNodes; ++b) {
    for (int a = 0; a <= b; ++a, ++pair) {
      for (int c = 0; c < 9; ++c) K[pair][c] = A[3 * a + c % 3][3 * b + c / 3];
    }
  }
}

/// The same for a tetrahedron whose matrix does not see translations, given as its blocks of the nodes 1 to
/// 3. In the orthonormal basis H = (1, 1, 1; 1, -1, -1; -1, 1, -1; -1, -1, 1) / 2 of what moves nodes against
/// each other its twelve rows are nine, B with K = H B H^T: B_mn is the sum of K_ab over a != m, b != n.
[[gnu::noinline]] inline void make_tetra_semidefinite(Batch (&K)[6][9]) {
  const auto entry = [&](int a, int b, int i, int j) {
    return a <= b ? K[b * (b + 1) / 2 + a][3 * j + i] : K[a * (a + 1) / 2 + b][3 * i + j];
  };
  Batch B[9][9];
  for (int m = 0; m < 9; ++m) {
    for (int n = m; n < 9; ++n) {
      Batch sum(0.0);
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          if (a != m / 3 && b != n / 3) sum += entry(a, b, m % 3, n % 3);
        }
      }
      B[m][n] = B[n][m] = sum;
    }
  }
  const Batch kept = make_semidefinite(B);
  if (all_above(kept, Batch(0.0))) return;
  for (int b = 0, pair = 0; b < 3; ++b) {
    for (int a = 0; a <= b; ++a, ++pair) {
      for (int c = 0; c < 9; ++c) {
        Batch sum(0.0);
        for (int m = 0; m < 3; ++m) {
          for (int n = 0; n < 3; ++n) {
            const Batch part = B[3 * m + c % 3][3 * n + c / 3];
            sum = (a == m) == (b == n) ? sum + part : sum - part;
          }
        }
        K[pair][c] = choose(kept, Batch(0.0), K[pair][c], Batch(0.25) * sum);
      }
    }
  }
}

}  // namespace tissu::TISSU_KERNELS
