#pragma once

#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// Hooke's law of small strain: W = lambda/2 tr(eps)^2 + mu tr(eps^2), eps = sym(F) - I.
///
/// Linear, so one tangent serves every state; not invariant to rotation: a body that turns by an angle a is
/// seen as strained by 1 - cos a, and swells. For displacements small beside the body.
template <class T>
struct Hooke {
  static constexpr std::string_view kName = "hooke";
  static constexpr bool kLinear = true;
  T lambda;  ///< [Pa]
  T mu;      ///< [Pa]

  static Tensor2<T> strain(const Tensor2<T>& F) {
    Tensor2<T> eps;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) eps(i, j) = (F(i, j) + F(j, i)) * T(0.5);
      eps(i, i) = F(i, i) - T(1.0);
    }
    return eps;
  }

  [[nodiscard]] T energy(const Tensor2<T>& F) const {
    const Tensor2<T> eps = strain(F);
    const T trace = eps(0, 0) + eps(1, 1) + eps(2, 2);
    T square = eps(0, 0) * eps(0, 0) + eps(1, 1) * eps(1, 1) + eps(2, 2) * eps(2, 2);
    square += T(2.0) * (eps(0, 1) * eps(0, 1) + eps(0, 2) * eps(0, 2) + eps(1, 2) * eps(1, 2));
    return lambda * T(0.5) * trace * trace + mu * square;
  }

  /// P = lambda tr(eps) I + 2 mu eps
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    const T pressure = lambda * (F(0, 0) + F(1, 1) + F(2, 2) - T(3.0));
    Tensor2<T> P;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) P(i, j) = mu * (F(i, j) + F(j, i));
      P(i, i) = T(2.0) * mu * (F(i, i) - T(1.0)) + pressure;
    }
    return P;
  }

  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& /*F*/, const Tensor2<T>& dF) const {
    const T pressure = lambda * (dF(0, 0) + dF(1, 1) + dF(2, 2));
    Tensor2<T> dP;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) dP(i, j) = mu * (dF(i, j) + dF(j, i));
      dP(i, i) += pressure;
    }
    return dP;
  }

  /// A_iJkL = lambda d_iJ d_kL + mu (d_ik d_JL + d_iL d_Jk)
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& /*F*/) const {
    Tangent<T> A;
    for (T& a : A.a) a = T(0.0);
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int J = 0; J < 3; ++J) A(i, J, i, J) = mu;
    }
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) A(i, i, i, i) = lambda + T(2.0) * mu;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int k = i + 1; k < 3; ++k) {
        A(i, i, k, k) = lambda;
        A(i, k, k, i) = mu;
      }
    }
    return A;
  }
};

}  // namespace tissu
