#pragma once

// Made from python/tissu/codegen/laws/hooke.py
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// Hooke's law of small strain.
///
/// For small displacements. The law is linear, so its tangent is constant. It is not invariant to
/// rotation: turning a body by an angle a gives a strain of 1 - cos a, so the body swells.
///
///     W = lam / 2 * tr(eps) ** 2 + mu * tr(eps * eps)
///
/// Operations:
/// - energy: 11 multiplications, 15 additions
/// - stress: 13 multiplications, 12 additions
/// - stress_change: 13 multiplications, 8 additions
/// - tangent: 3 multiplications, 3 additions
template <class T>
struct Hooke {
  static constexpr std::string_view kName = "hooke";
  static constexpr bool kLinear = true;           ///< one tangent serves every F
  static constexpr bool kFrameInvariant = false;  ///< blind to rotation
  static constexpr bool kIsotropic = false;       ///< blind to the axes of the rest shape
  static constexpr bool kHomogeneous = true;      ///< in proportion to its constants
  static constexpr bool kAddition = false;        ///< to be added to a base law
  T lambda;                                       ///< poisson*young/((1 - 2*poisson)*(poisson + 1))
  T mu;                                           ///< young/(2*poisson + 2)

  /// W [J/m3]
  [[nodiscard]] T energy(const Tensor2<T>& F) const {
    const T tr_eps = F(0, 0) + F(1, 1) + F(2, 2) - T(3.0);
    const T H01 = F(0, 1) + F(1, 0);
    const T H02 = F(0, 2) + F(2, 0);
    const T H12 = F(1, 2) + F(2, 1);
    const T e0 = F(0, 0) - T(1.0);
    const T e1 = F(1, 1) - T(1.0);
    const T e2 = F(2, 2) - T(1.0);
    const T off_diagonal = H01 * H01 + H02 * H02 + H12 * H12;
    const T tr_eps2 = e0 * e0 + e1 * e1 + e2 * e2 + T(0.5) * off_diagonal;
    const T W = mu * tr_eps2 + T(0.5) * lambda * tr_eps * tr_eps;
    return W;
  }

  /// P = dW/dF [Pa]
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    const T tr_eps = F(0, 0) + F(1, 1) + F(2, 2) - T(3.0);
    const T p_I = lambda * tr_eps;
    const T H01 = F(0, 1) + F(1, 0);
    const T H02 = F(0, 2) + F(2, 0);
    const T H12 = F(1, 2) + F(2, 1);
    Tensor2<T> P;
    P(0, 0) = p_I + mu * (T(2.0) * F(0, 0) - T(2.0));
    P(0, 1) = H01 * mu;
    P(0, 2) = H02 * mu;
    P(1, 0) = H01 * mu;
    P(1, 1) = p_I + mu * (T(2.0) * F(1, 1) - T(2.0));
    P(1, 2) = H12 * mu;
    P(2, 0) = H02 * mu;
    P(2, 1) = H12 * mu;
    P(2, 2) = p_I + mu * (T(2.0) * F(2, 2) - T(2.0));
    return P;
  }

  /// dP = dP/dF : dF [Pa]
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& /*F*/, const Tensor2<T>& dF) const {
    const T along_I = dF(0, 0) + dF(1, 1) + dF(2, 2);
    const T dp_I = along_I * lambda;
    const T dH00 = T(2.0) * dF(0, 0);
    const T dH01 = dF(0, 1) + dF(1, 0);
    const T dH02 = dF(0, 2) + dF(2, 0);
    const T dH11 = T(2.0) * dF(1, 1);
    const T dH12 = dF(1, 2) + dF(2, 1);
    const T dH22 = T(2.0) * dF(2, 2);
    Tensor2<T> dP;
    dP(0, 0) = dp_I + dH00 * mu;
    dP(0, 1) = dH01 * mu;
    dP(0, 2) = dH02 * mu;
    dP(1, 0) = dH01 * mu;
    dP(1, 1) = dp_I + dH11 * mu;
    dP(1, 2) = dH12 * mu;
    dP(2, 0) = dH02 * mu;
    dP(2, 1) = dH12 * mu;
    dP(2, 2) = dp_I + dH22 * mu;
    return dP;
  }

  /// dP/dF, upper triangle [Pa]
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& /*F*/) const {
    Tangent<T> A;
    A(0, 0, 0, 0) = lambda + T(2.0) * mu;
    A(0, 0, 0, 1) = T(0.0);
    A(0, 0, 0, 2) = T(0.0);
    A(0, 0, 1, 0) = T(0.0);
    A(0, 0, 1, 1) = lambda;
    A(0, 0, 1, 2) = T(0.0);
    A(0, 0, 2, 0) = T(0.0);
    A(0, 0, 2, 1) = T(0.0);
    A(0, 0, 2, 2) = lambda;
    A(0, 1, 0, 1) = mu;
    A(0, 1, 0, 2) = T(0.0);
    A(0, 1, 1, 0) = mu;
    A(0, 1, 1, 1) = T(0.0);
    A(0, 1, 1, 2) = T(0.0);
    A(0, 1, 2, 0) = T(0.0);
    A(0, 1, 2, 1) = T(0.0);
    A(0, 1, 2, 2) = T(0.0);
    A(0, 2, 0, 2) = mu;
    A(0, 2, 1, 0) = T(0.0);
    A(0, 2, 1, 1) = T(0.0);
    A(0, 2, 1, 2) = T(0.0);
    A(0, 2, 2, 0) = mu;
    A(0, 2, 2, 1) = T(0.0);
    A(0, 2, 2, 2) = T(0.0);
    A(1, 0, 1, 0) = mu;
    A(1, 0, 1, 1) = T(0.0);
    A(1, 0, 1, 2) = T(0.0);
    A(1, 0, 2, 0) = T(0.0);
    A(1, 0, 2, 1) = T(0.0);
    A(1, 0, 2, 2) = T(0.0);
    A(1, 1, 1, 1) = lambda + T(2.0) * mu;
    A(1, 1, 1, 2) = T(0.0);
    A(1, 1, 2, 0) = T(0.0);
    A(1, 1, 2, 1) = T(0.0);
    A(1, 1, 2, 2) = lambda;
    A(1, 2, 1, 2) = mu;
    A(1, 2, 2, 0) = T(0.0);
    A(1, 2, 2, 1) = mu;
    A(1, 2, 2, 2) = T(0.0);
    A(2, 0, 2, 0) = mu;
    A(2, 0, 2, 1) = T(0.0);
    A(2, 0, 2, 2) = T(0.0);
    A(2, 1, 2, 1) = mu;
    A(2, 1, 2, 2) = T(0.0);
    A(2, 2, 2, 2) = lambda + T(2.0) * mu;
    return A;
  }

  // The same of a sheet, F of 3 x 2, in axes whose first 2 lie in it.
  [[nodiscard]] T energy(const Columns<T, 2>& F) const {
    const T e01 = T(0.5) * F(0, 1) + T(0.5) * F(1, 0);
    const T e00 = F(0, 0) - T(1.0);
    const T e11 = F(1, 1) - T(1.0);
    const T tr_eps = e00 + e11;
    const T tr_eps2 = e00 * e00 + e11 * e11 + T(2.0) * e01 * e01;
    const T W = mu * tr_eps2 + T(0.5) * lambda * tr_eps * tr_eps;
    return W;
  }
  [[nodiscard]] Columns<T, 2> stress(const Columns<T, 2>& F) const {
    const T e01 = T(0.5) * F(0, 1) + T(0.5) * F(1, 0);
    const T e00 = F(0, 0) - T(1.0);
    const T e11 = F(1, 1) - T(1.0);
    const T tr_eps = e00 + e11;
    const T W_1 = lambda * tr_eps;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    const T S11 = W_1 + T(2.0) * e11 * mu;
    const T S01 = T(2.0) * e01 * mu;
    Columns<T, 2> P;
    P(0, 0) = S00;
    P(0, 1) = S01;
    P(1, 0) = S01;
    P(1, 1) = S11;
    P(2, 0) = T(0.0);
    P(2, 1) = T(0.0);
    return P;
  }
  [[nodiscard]] Columns<T, 2> stress_change(const Columns<T, 2>& /*F*/, const Columns<T, 2>& dF) const {
    const T de01 = T(0.5) * dF(0, 1) + T(0.5) * dF(1, 0);
    const T along_1 = dF(0, 0) + dF(1, 1);
    const T dW_1 = along_1 * lambda;
    const T T00 = dW_1 + T(2.0) * dF(0, 0) * mu;
    const T T11 = dW_1 + T(2.0) * dF(1, 1) * mu;
    const T T01 = T(2.0) * de01 * mu;
    Columns<T, 2> dP;
    dP(0, 0) = T00;
    dP(0, 1) = T01;
    dP(1, 0) = T01;
    dP(1, 1) = T11;
    dP(2, 0) = T(0.0);
    dP(2, 1) = T(0.0);
    return dP;
  }
  [[nodiscard]] ColumnsTangent<T, 2> tangent(const Columns<T, 2>& /*F*/) const {
    ColumnsTangent<T, 2> A;
    A(0, 0, 0, 0) = lambda + T(2.0) * mu;
    A(0, 0, 0, 1) = T(0.0);
    A(0, 0, 1, 0) = T(0.0);
    A(0, 0, 1, 1) = lambda;
    A(0, 0, 2, 0) = T(0.0);
    A(0, 0, 2, 1) = T(0.0);
    A(0, 1, 0, 1) = mu;
    A(0, 1, 1, 0) = mu;
    A(0, 1, 1, 1) = T(0.0);
    A(0, 1, 2, 0) = T(0.0);
    A(0, 1, 2, 1) = T(0.0);
    A(1, 0, 1, 0) = mu;
    A(1, 0, 1, 1) = T(0.0);
    A(1, 0, 2, 0) = T(0.0);
    A(1, 0, 2, 1) = T(0.0);
    A(1, 1, 1, 1) = lambda + T(2.0) * mu;
    A(1, 1, 2, 0) = T(0.0);
    A(1, 1, 2, 1) = T(0.0);
    A(2, 0, 2, 0) = T(0.0);
    A(2, 0, 2, 1) = T(0.0);
    A(2, 1, 2, 1) = T(0.0);
    return A;
  }

  // The same of a line, F of 3 x 1, in axes whose first 1 lie in it.
  [[nodiscard]] T energy(const Columns<T, 1>& F) const {
    const T e00 = F(0, 0) - T(1.0);
    const T tr_eps = e00;
    const T tr_eps2 = e00 * e00;
    const T W = mu * tr_eps2 + T(0.5) * lambda * tr_eps * tr_eps;
    return W;
  }
  [[nodiscard]] Columns<T, 1> stress(const Columns<T, 1>& F) const {
    const T e00 = F(0, 0) - T(1.0);
    const T tr_eps = e00;
    const T W_1 = lambda * tr_eps;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    Columns<T, 1> P;
    P(0, 0) = S00;
    P(1, 0) = T(0.0);
    P(2, 0) = T(0.0);
    return P;
  }
  [[nodiscard]] Columns<T, 1> stress_change(const Columns<T, 1>& /*F*/, const Columns<T, 1>& dF) const {
    const T dW_1 = dF(0, 0) * lambda;
    const T T00 = dW_1 + T(2.0) * dF(0, 0) * mu;
    Columns<T, 1> dP;
    dP(0, 0) = T00;
    dP(1, 0) = T(0.0);
    dP(2, 0) = T(0.0);
    return dP;
  }
  [[nodiscard]] ColumnsTangent<T, 1> tangent(const Columns<T, 1>& /*F*/) const {
    ColumnsTangent<T, 1> A;
    A(0, 0, 0, 0) = lambda + T(2.0) * mu;
    A(0, 0, 1, 0) = T(0.0);
    A(0, 0, 2, 0) = T(0.0);
    A(1, 0, 1, 0) = T(0.0);
    A(1, 0, 2, 0) = T(0.0);
    A(2, 0, 2, 0) = T(0.0);
    return A;
  }
};

}  // namespace tissu
