#pragma once

/// Kelvin–Voigt at a material point, whatever its reference dimension M:
///
///     S_v = 2 eta dE/dt + zeta tr(dE/dt) I,   dE/dt = sym(F^T dF/dt),   P_v = F S_v
///
/// S_v [Pa] of viscosities [Pa s]. P_v is linear in the rate dF/dt, so it is asked for as a change of stress,
/// and its matrix is symmetric: power = P_v : dF/dt = 2 eta |dE/dt|^2 + zeta tr(dE/dt)^2.

#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

template <class T>
struct StrainRate {
  static constexpr std::string_view kName = "strain rate";
  T zeta;
  T eta;

  /// P_v for dF = dF/dt
  template <int M>
  [[nodiscard]] Columns<T, M> stress_change(const Columns<T, M>& F, const Columns<T, M>& dF) const {
    T D[M][M];  // F^T dF
    T trace(0.0);
    TISSU_UNROLL
    for (int i = 0; i < M; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < M; ++j) D[i][j] = F(0, i) * dF(0, j) + F(1, i) * dF(1, j) + F(2, i) * dF(2, j);
      trace += D[i][i];
    }
    const T spherical = zeta * trace;
    Columns<T, M> P;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < M; ++j) {
        T sum = F(i, j) * spherical;
        TISSU_UNROLL
        for (int k = 0; k < M; ++k) sum += F(i, k) * eta * (D[k][j] + D[j][k]);
        P(i, j) = sum;
      }
    }
    return P;
  }

  /// dP_v,iJ / d(dF/dt)_kL = zeta F_iJ F_kL + eta ((F F^T)_ik delta_JL + F_iL F_kJ)
  template <int M>
  [[nodiscard]] ColumnsTangent<T, M> tangent(const Columns<T, M>& F) const {
    ColumnsTangent<T, M> A;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int k = i; k < 3; ++k) {
        T b = F(i, 0) * F(k, 0);
        TISSU_UNROLL
        for (int m = 1; m < M; ++m) b += F(i, m) * F(k, m);
        TISSU_UNROLL
        for (int J = 0; J < M; ++J) {
          TISSU_UNROLL
          for (int L = i == k ? J : 0; L < M; ++L) {
            T value = zeta * F(i, J) * F(k, L) + eta * F(i, L) * F(k, J);
            if (J == L) value += eta * b;
            A(i, J, k, L) = value;
          }
        }
      }
    }
    return A;
  }
};

}  // namespace tissu
