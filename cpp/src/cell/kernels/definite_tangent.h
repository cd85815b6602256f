#pragma once

/// dP/dF at a point, its negative eigenvalues replaced by zero: the nearest positive semi-definite one.
///
/// Of an isotropic law, in the axes of F = U diag(s) V^T, dP/dF couples the three stretches with each other
/// (3 x 3), and each of the three pairs of shears F_ab, F_ba with itself (2 x 2, a_abab and a_abba): a twist
/// and a flip, whose eigenvalues are the difference and the sum of the two. So it is read off the law's own
/// tangent at diag(s), clamped there, and turned back.
///
/// Teran, Sifakis, Irving, Fedkiw, Robust quasistatic finite elements and flesh simulation, SCA 2005; the
/// modes: Smith, de Goes, Kim, Analytic eigensystems for isotropic distortion energies, ACM TOG 38(1), 2019.

#include "semidefinite.h"
#include "singular_values.h"

namespace tissu::TISSU_KERNELS {

/// The tangent of an isotropic law at diag(s).
struct PrincipalTangent {
  static constexpr int kPair[3][2] = {{0, 1}, {0, 2}, {1, 2}};

  Batch stretch[3][3];
  Batch own[3];   ///< a_abab
  Batch twin[3];  ///< a_abba

  TISSU_INLINE explicit PrincipalTangent(const Tangent<Batch>& at) {
    TISSU_UNROLL
    for (int a = 0; a < 3; ++a) {
      TISSU_UNROLL
      for (int b = 0; b < 3; ++b) stretch[a][b] = at(a, a, b, b);
      const int i = kPair[a][0];
      const int j = kPair[a][1];
      own[a] = Batch(0.5) * (at(i, j, i, j) + at(j, i, j, i));
      twin[a] = at(i, j, j, i);
    }
  }
  TISSU_INLINE void clamp() {
    make_semidefinite(stretch);
    TISSU_UNROLL
    for (int p = 0; p < 3; ++p) {
      const Batch flip = not_negative(own[p] + twin[p]);
      const Batch twist = not_negative(own[p] - twin[p]);
      own[p] = Batch(0.5) * (flip + twist);
      twin[p] = Batch(0.5) * (flip - twist);
    }
  }
};

/// A_iJkL = sum U_ia V_Jb a_abcd U_kc V_Ld
[[gnu::noinline]] inline void turn_tangent(const PrincipalTangent& a, const Matrix& U, const Matrix& V,
                                           Tangent<Batch>& A) {
  Batch Q[9][9];  // row 3 a + b: U_ia V_Jb
  Batch W[9][9];  // a Q
  for (int r = 0; r < 9; ++r) {
    for (int k = 0; k < 9; ++k) Q[r][k] = U(k / 3, r / 3) * V(k % 3, r % 3);
  }
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 9; ++k) {
      W[4 * r][k] = a.stretch[r][0] * Q[0][k] + a.stretch[r][1] * Q[4][k] + a.stretch[r][2] * Q[8][k];
    }
  }
  for (int p = 0; p < 3; ++p) {
    const int ab = 3 * PrincipalTangent::kPair[p][0] + PrincipalTangent::kPair[p][1];
    const int ba = 3 * PrincipalTangent::kPair[p][1] + PrincipalTangent::kPair[p][0];
    for (int k = 0; k < 9; ++k) {
      W[ab][k] = a.own[p] * Q[ab][k] + a.twin[p] * Q[ba][k];
      W[ba][k] = a.twin[p] * Q[ab][k] + a.own[p] * Q[ba][k];
    }
  }
  for (int i = 0; i < 9; ++i) {
    for (int j = i; j < 9; ++j) {
      Batch sum = Q[0][i] * W[0][j];
      for (int r = 1; r < 9; ++r) sum += Q[r][i] * W[r][j];
      A.a[Tangent<Batch>::index(i, j)] = sum;
    }
  }
}

/// The axes of F, and F in them.
struct PrincipalAxes {
  Matrix U;
  Matrix V;
  Matrix stretch;  ///< diagonal

  [[gnu::noinline]] void find(const Matrix& F) {
    const SingularValues of(F);
    U = of.U;
    V = of.V;
    for (int k = 0; k < 9; ++k) stretch.m[k / 3][k % 3] = k % 4 == 0 ? of.s[k / 4] : Batch(0.0);
  }
  /// From the law's tangent at `stretch` to the definite one at F.
  [[gnu::noinline]] void make_definite(Tangent<Batch>& A) const {
    PrincipalTangent principal(A);
    principal.clamp();
    turn_tangent(principal, U, V, A);
  }
};

/// Of any law: `A` [entry of the upper triangle, row after row][8], of a symmetric matrix of n rows.
template <int n>
[[gnu::noinline]] void make_tangents_semidefinite(double* A) {
  for (int lane = 0; lane < kLanes; lane += kWidth) {
    Batch full[n][n];
    double* entry = A + lane;
    for (int i = 0; i < n; ++i) {
      for (int j = i; j < n; ++j, entry += kLanes) full[i][j] = full[j][i] = Batch::load(entry);
    }
    make_semidefinite(full);
    entry = A + lane;
    for (int i = 0; i < n; ++i) {
      for (int j = i; j < n; ++j, entry += kLanes) full[i][j].store(entry);
    }
  }
}

}  // namespace tissu::TISSU_KERNELS
