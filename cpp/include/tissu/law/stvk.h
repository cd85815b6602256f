#pragma once

#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// St-Venant–Kirchhoff: W = lambda/2 tr(E)^2 + mu tr(E^2), E = (F^T F - I) / 2.
///
/// Right for large rotations at moderate strain. Under compression it loses strength at a stretch of
/// 1/sqrt(3) = 0.577 and does not resist inversion: that is the law's own limit, not the mesh's.
template <class T>
struct StVK {
  static constexpr std::string_view kName = "stvk";
  static constexpr bool kLinear = false;
  T lambda;  ///< [Pa]
  T mu;      ///< [Pa]

  /// E: xx, yy, zz, yz, xz, xy
  struct Strain {
    T e[6];
  };

  static Strain strain(const Tensor2<T>& F) {
    const auto dot = [&](int j, int k) { return F(0, j) * F(0, k) + F(1, j) * F(1, k) + F(2, j) * F(2, k); };
    const T half(0.5);
    return {{(dot(0, 0) - T(1.0)) * half, (dot(1, 1) - T(1.0)) * half, (dot(2, 2) - T(1.0)) * half,
             dot(1, 2) * half, dot(0, 2) * half, dot(0, 1) * half}};
  }

  /// S = lambda tr(E) I + 2 mu E
  [[nodiscard]] Tensor2<T> second_stress(const Strain& E) const {
    const T pressure = lambda * (E.e[0] + E.e[1] + E.e[2]);
    const T mu2 = mu + mu;
    const T yz = mu2 * E.e[3];
    const T xz = mu2 * E.e[4];
    const T xy = mu2 * E.e[5];
    return {{{mu2 * E.e[0] + pressure, xy, xz},
             {xy, mu2 * E.e[1] + pressure, yz},
             {xz, yz, mu2 * E.e[2] + pressure}}};
  }

  [[nodiscard]] T energy(const Tensor2<T>& F) const {
    const Strain E = strain(F);
    const T trace = E.e[0] + E.e[1] + E.e[2];
    const T diagonal = E.e[0] * E.e[0] + E.e[1] * E.e[1] + E.e[2] * E.e[2];
    const T shear = E.e[3] * E.e[3] + E.e[4] * E.e[4] + E.e[5] * E.e[5];
    return lambda * T(0.5) * trace * trace + mu * (diagonal + T(2.0) * shear);
  }

  /// P = F S
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const { return product(F, second_stress(strain(F))); }

  /// dP = dF S + F (lambda tr(dE) I + 2 mu dE), dE = sym(F^T dF)
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
    const Tensor2<T> C = transposed_product(F, dF);
    const T half(0.5);
    const Strain dE{{C(0, 0), C(1, 1), C(2, 2), (C(1, 2) + C(2, 1)) * half, (C(0, 2) + C(2, 0)) * half,
                     (C(0, 1) + C(1, 0)) * half}};
    const Tensor2<T> first = product(dF, second_stress(strain(F)));
    Tensor2<T> dP = product(F, second_stress(dE));
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) dP(i, j) += first(i, j);
    }
    return dP;
  }

  /// A_iJkL = d_ik S_JL + lambda F_iJ F_kL + mu F_iL F_kJ + mu d_JL (F F^T)_ik
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
    const Tensor2<T> S = second_stress(strain(F));
    const Tensor2<T> B = product_transposed(F, F);
    Tensor2<T> lambda_F;
    Tensor2<T> mu_F;
    Tensor2<T> mu_B;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) {
        lambda_F(i, j) = lambda * F(i, j);
        mu_F(i, j) = mu * F(i, j);
        mu_B(i, j) = mu * B(i, j);
      }
    }
    Tangent<T> A;
    TISSU_UNROLL
    for (int row = 0; row < 9; ++row) {
      TISSU_UNROLL
      for (int column = row; column < 9; ++column) {
        const int i = row / 3;
        const int J = row % 3;
        const int k = column / 3;
        const int L = column % 3;
        T a = lambda_F(i, J) * F(k, L) + mu_F(i, L) * F(k, J);
        if (J == L) a += mu_B(i, k);
        if (i == k) a += S(J, L);
        A(i, J, k, L) = a;
      }
    }
    return A;
  }
};

}  // namespace tissu
