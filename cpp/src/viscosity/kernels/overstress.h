#pragma once

/// The stress of all branches of a Prony series at a material point, at the end of a step through which E
/// goes evenly:
///
///     S = sum_k g_k C : q_k,   q_k = a_k q_k0 + b_k (E - E0)
///       = lambda' tr(E) I + 2 mu' E + H,   (lambda', mu') = (lambda, mu) sum_k g_k b_k,
///     H = C : sum_k g_k (a_k q_k0 - b_k E0)
///
/// which is St-Venant–Kirchhoff's law with a stress H that E does not change: symmetric, and rotations are
/// not seen.

#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

template <class T>
struct Overstress {
  static constexpr std::string_view kName = "overstress";
  T lambda;
  T mu;
  T H[6];  ///< xx yy zz yz xz xy

  using Symmetric = T[3][3];

  /// lambda tr(e) I + 2 mu e
  void elastic(const Symmetric& e, Symmetric& S) const {
    const T spherical = lambda * (e[0][0] + e[1][1] + e[2][2]);
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) S[i][j] = T(2.0) * mu * e[i][j];
      S[i][i] += spherical;
    }
  }
  /// sym(A^T B)
  static void symmetric_part(const Tensor2<T>& A, const Tensor2<T>& B, Symmetric& e) {
    const Tensor2<T> D = transposed_product(A, B);
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) e[i][j] = T(0.5) * (D(i, j) + D(j, i));
    }
  }
  [[gnu::always_inline]] void second_stress(const Tensor2<T>& F, Symmetric& S) const {
    Symmetric E;
    symmetric_part(F, F, E);
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) E[i][j] = T(0.5) * (E[i][j] - T(i == j ? 1.0 : 0.0));
    }
    elastic(E, S);
    constexpr int entry[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) S[i][j] += H[entry[i][j]];
    }
  }
  /// The same as a call. What the compiler contracts to a fused product ends at a call, so where one stands
  /// is part of the bits: it is written here, and not left to what else the source holds.
  [[gnu::noinline]] void call_second_stress(const Tensor2<T>& F, Symmetric& S) const { second_stress(F, S); }
  /// Within its caller where there are 32 wide registers, by a call elsewhere.
  [[gnu::always_inline]] void second_stress_of_set(const Tensor2<T>& F, Symmetric& S) const {
    if constexpr (sizeof(T) == 64) {
      second_stress(F, S);
    } else {
      call_second_stress(F, S);
    }
  }
  /// P += F S
  static void add_product(const Tensor2<T>& F, const Symmetric& S, Tensor2<T>& P) {
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) P(i, j) += F(i, 0) * S[0][j] + F(i, 1) * S[1][j] + F(i, 2) * S[2][j];
    }
  }
  static Tensor2<T> zero() {
    Tensor2<T> Z;
    for (auto& row : Z.m) {
      for (T& entry : row) entry = T(0.0);
    }
    return Z;
  }

  /// P = F S
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    Symmetric S;
    second_stress_of_set(F, S);
    Tensor2<T> P = zero();
    add_product(F, S, P);
    return P;
  }
  /// dP = dF S + F (lambda' tr(dE) I + 2 mu' dE)
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
    Symmetric S;
    Symmetric dE;
    Symmetric dS;
    call_second_stress(F, S);
    symmetric_part(F, dF, dE);
    elastic(dE, dS);
    Tensor2<T> dP = zero();
    add_product(dF, S, dP);
    add_product(F, dS, dP);
    return dP;
  }
  /// dP_iJ/dF_kL = delta_ik S_JL + lambda' F_iJ F_kL + mu' ((F F^T)_ik delta_JL + F_iL F_kJ)
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
    Symmetric S;
    second_stress_of_set(F, S);
    Tangent<T> A;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int k = i; k < 3; ++k) {
        const T b = F(i, 0) * F(k, 0) + F(i, 1) * F(k, 1) + F(i, 2) * F(k, 2);
        TISSU_UNROLL
        for (int J = 0; J < 3; ++J) {
          TISSU_UNROLL
          for (int L = i == k ? J : 0; L < 3; ++L) {
            T value = lambda * F(i, J) * F(k, L) + mu * F(i, L) * F(k, J);
            if (J == L) value += mu * b;
            if (i == k) value += S[J][L];
            A(i, J, k, L) = value;
          }
        }
      }
    }
    return A;
  }
};

}  // namespace tissu
