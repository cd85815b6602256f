#pragma once

// Made from python/tissu/codegen/laws/stvk.py
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// St-Venant–Kirchhoff.
///
/// Valid for large rotations at moderate strain. In compression it loses stiffness at a stretch of
/// 1/sqrt(3) = 0.577, and it does not resist inversion. This is a limit of the law, not of the mesh.
///
///     W = lam / 2 * tr(E) ** 2 + mu * tr(E * E)
///
/// Operations:
/// - energy: 31 multiplications, 24 additions
/// - stress: 53 multiplications, 37 additions
/// - stress_change: 115 multiplications, 90 additions
/// - tangent: 131 multiplications, 86 additions
template <class T>
struct StVK {
  static constexpr std::string_view kName = "stvk";
  static constexpr bool kLinear = false;         ///< one tangent serves every F
  static constexpr bool kFrameInvariant = true;  ///< blind to rotation
  static constexpr bool kIsotropic = true;       ///< blind to the axes of the rest shape
  static constexpr bool kHomogeneous = true;     ///< in proportion to its constants
  static constexpr bool kAddition = false;       ///< to be added to a base law
  T lambda;                                      ///< poisson*young/((1 - 2*poisson)*(poisson + 1))
  T mu;                                          ///< young/(2*poisson + 2)

  /// W [J/m3]
  [[nodiscard]] T energy(const Tensor2<T>& F) const {
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T tr_2E = C00 + C11 + C22 - T(3.0);
    const T tr_E = T(0.5) * tr_2E;
    const T e0 = C00 - T(1.0);
    const T e1 = C11 - T(1.0);
    const T e2 = C22 - T(1.0);
    const T on_diagonal = e0 * e0 + e1 * e1 + e2 * e2;
    const T off_diagonal = C01 * C01 + C02 * C02 + C12 * C12;
    const T tr_E2 = T(0.5) * off_diagonal + T(0.25) * on_diagonal;
    const T W = mu * tr_E2 + T(0.5) * lambda * tr_E * tr_E;
    return W;
  }

  /// P = dW/dF [Pa]
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T tr_2E = C00 + C11 + C22 - T(3.0);
    const T tr_E = T(0.5) * tr_2E;
    const T p_F = lambda * tr_E - mu;
    const T S00 = p_F + C00 * mu;
    const T S01 = C01 * mu;
    const T S02 = C02 * mu;
    const T S11 = p_F + C11 * mu;
    const T S12 = C12 * mu;
    const T S22 = p_F + C22 * mu;
    Tensor2<T> P;
    P(0, 0) = F(0, 0) * S00 + F(0, 1) * S01 + F(0, 2) * S02;
    P(0, 1) = F(0, 0) * S01 + F(0, 1) * S11 + F(0, 2) * S12;
    P(0, 2) = F(0, 0) * S02 + F(0, 1) * S12 + F(0, 2) * S22;
    P(1, 0) = F(1, 0) * S00 + F(1, 1) * S01 + F(1, 2) * S02;
    P(1, 1) = F(1, 0) * S01 + F(1, 1) * S11 + F(1, 2) * S12;
    P(1, 2) = F(1, 0) * S02 + F(1, 1) * S12 + F(1, 2) * S22;
    P(2, 0) = F(2, 0) * S00 + F(2, 1) * S01 + F(2, 2) * S02;
    P(2, 1) = F(2, 0) * S01 + F(2, 1) * S11 + F(2, 2) * S12;
    P(2, 2) = F(2, 0) * S02 + F(2, 1) * S12 + F(2, 2) * S22;
    return P;
  }

  /// dP = dP/dF : dF [Pa]
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T tr_2E = C00 + C11 + C22 - T(3.0);
    const T tr_E = T(0.5) * tr_2E;
    const T p_F = lambda * tr_E - mu;
    const T S00 = p_F + C00 * mu;
    const T S01 = C01 * mu;
    const T S02 = C02 * mu;
    const T S11 = p_F + C11 * mu;
    const T S12 = C12 * mu;
    const T S22 = p_F + C22 * mu;
    const T Q00 = S00 * dF(0, 0) + S01 * dF(0, 1) + S02 * dF(0, 2);
    const T Q01 = S01 * dF(0, 0) + S11 * dF(0, 1) + S12 * dF(0, 2);
    const T Q02 = S02 * dF(0, 0) + S12 * dF(0, 1) + S22 * dF(0, 2);
    const T Q10 = S00 * dF(1, 0) + S01 * dF(1, 1) + S02 * dF(1, 2);
    const T Q11 = S01 * dF(1, 0) + S11 * dF(1, 1) + S12 * dF(1, 2);
    const T Q12 = S02 * dF(1, 0) + S12 * dF(1, 1) + S22 * dF(1, 2);
    const T Q20 = S00 * dF(2, 0) + S01 * dF(2, 1) + S02 * dF(2, 2);
    const T Q21 = S01 * dF(2, 0) + S11 * dF(2, 1) + S12 * dF(2, 2);
    const T Q22 = S02 * dF(2, 0) + S12 * dF(2, 1) + S22 * dF(2, 2);
    const T D00 = F(0, 0) * dF(0, 0) + F(1, 0) * dF(1, 0) + F(2, 0) * dF(2, 0);
    const T D01 = F(0, 0) * dF(0, 1) + F(1, 0) * dF(1, 1) + F(2, 0) * dF(2, 1);
    const T D02 = F(0, 0) * dF(0, 2) + F(1, 0) * dF(1, 2) + F(2, 0) * dF(2, 2);
    const T D10 = F(0, 1) * dF(0, 0) + F(1, 1) * dF(1, 0) + F(2, 1) * dF(2, 0);
    const T D11 = F(0, 1) * dF(0, 1) + F(1, 1) * dF(1, 1) + F(2, 1) * dF(2, 1);
    const T D12 = F(0, 1) * dF(0, 2) + F(1, 1) * dF(1, 2) + F(2, 1) * dF(2, 2);
    const T D20 = F(0, 2) * dF(0, 0) + F(1, 2) * dF(1, 0) + F(2, 2) * dF(2, 0);
    const T D21 = F(0, 2) * dF(0, 1) + F(1, 2) * dF(1, 1) + F(2, 2) * dF(2, 1);
    const T D22 = F(0, 2) * dF(0, 2) + F(1, 2) * dF(1, 2) + F(2, 2) * dF(2, 2);
    const T along_F = D00 + D11 + D22;
    const T dp_F = along_F * lambda;
    const T twice_p_FC = T(2.0) * mu;
    const T D01s = D01 + D10;
    const T D02s = D02 + D20;
    const T D12s = D12 + D21;
    const T T00 = dp_F + D00 * twice_p_FC;
    const T T01 = D01s * mu;
    const T T02 = D02s * mu;
    const T T11 = dp_F + D11 * twice_p_FC;
    const T T12 = D12s * mu;
    const T T22 = dp_F + D22 * twice_p_FC;
    Tensor2<T> dP;
    dP(0, 0) = Q00 + F(0, 0) * T00 + F(0, 1) * T01 + F(0, 2) * T02;
    dP(0, 1) = Q01 + F(0, 0) * T01 + F(0, 1) * T11 + F(0, 2) * T12;
    dP(0, 2) = Q02 + F(0, 0) * T02 + F(0, 1) * T12 + F(0, 2) * T22;
    dP(1, 0) = Q10 + F(1, 0) * T00 + F(1, 1) * T01 + F(1, 2) * T02;
    dP(1, 1) = Q11 + F(1, 0) * T01 + F(1, 1) * T11 + F(1, 2) * T12;
    dP(1, 2) = Q12 + F(1, 0) * T02 + F(1, 1) * T12 + F(1, 2) * T22;
    dP(2, 0) = Q20 + F(2, 0) * T00 + F(2, 1) * T01 + F(2, 2) * T02;
    dP(2, 1) = Q21 + F(2, 0) * T01 + F(2, 1) * T11 + F(2, 2) * T12;
    dP(2, 2) = Q22 + F(2, 0) * T02 + F(2, 1) * T12 + F(2, 2) * T22;
    return dP;
  }

  /// dP/dF, upper triangle [Pa]
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T tr_2E = C00 + C11 + C22 - T(3.0);
    const T tr_E = T(0.5) * tr_2E;
    const T p_F = lambda * tr_E - mu;
    const T r_F_00 = F(0, 0) * lambda;
    const T r_F_01 = F(0, 1) * lambda;
    const T r_F_02 = F(0, 2) * lambda;
    const T r_F_10 = F(1, 0) * lambda;
    const T r_F_11 = F(1, 1) * lambda;
    const T r_F_12 = F(1, 2) * lambda;
    const T m_F_F_p_FC = lambda + mu;
    const T rb_F_00 = F(0, 0) * m_F_F_p_FC;
    const T rb_F_01 = F(0, 1) * m_F_F_p_FC;
    const T rb_F_02 = F(0, 2) * m_F_F_p_FC;
    const T rb_F_10 = F(1, 0) * m_F_F_p_FC;
    const T rb_F_11 = F(1, 1) * m_F_F_p_FC;
    const T rb_F_12 = F(1, 2) * m_F_F_p_FC;
    const T rb_F_20 = F(2, 0) * m_F_F_p_FC;
    const T rb_F_21 = F(2, 1) * m_F_F_p_FC;
    const T rb_F_22 = F(2, 2) * m_F_F_p_FC;
    const T S00 = p_F + C00 * mu;
    const T S01 = C01 * mu;
    const T S02 = C02 * mu;
    const T S11 = p_F + C11 * mu;
    const T S12 = C12 * mu;
    const T S22 = p_F + C22 * mu;
    const T bF00 = F(0, 0) * mu;
    const T bF01 = F(0, 1) * mu;
    const T bF02 = F(0, 2) * mu;
    const T bF10 = F(1, 0) * mu;
    const T bF11 = F(1, 1) * mu;
    const T bF12 = F(1, 2) * mu;
    const T bF20 = F(2, 0) * mu;
    const T bF21 = F(2, 1) * mu;
    const T bF22 = F(2, 2) * mu;
    const T B00 = F(0, 0) * bF00 + F(0, 1) * bF01 + F(0, 2) * bF02;
    const T B01 = F(1, 0) * bF00 + F(1, 1) * bF01 + F(1, 2) * bF02;
    const T B02 = F(2, 0) * bF00 + F(2, 1) * bF01 + F(2, 2) * bF02;
    const T B11 = F(1, 0) * bF10 + F(1, 1) * bF11 + F(1, 2) * bF12;
    const T B12 = F(2, 0) * bF10 + F(2, 1) * bF11 + F(2, 2) * bF12;
    const T B22 = F(2, 0) * bF20 + F(2, 1) * bF21 + F(2, 2) * bF22;
    Tangent<T> A;
    A(0, 0, 0, 0) = B00 + S00 + F(0, 0) * rb_F_00;
    A(0, 0, 0, 1) = S01 + F(0, 1) * rb_F_00;
    A(0, 0, 0, 2) = S02 + F(0, 2) * rb_F_00;
    A(0, 0, 1, 0) = B01 + F(1, 0) * rb_F_00;
    A(0, 0, 1, 1) = F(1, 0) * bF01 + F(1, 1) * r_F_00;
    A(0, 0, 1, 2) = F(1, 0) * bF02 + F(1, 2) * r_F_00;
    A(0, 0, 2, 0) = B02 + F(2, 0) * rb_F_00;
    A(0, 0, 2, 1) = F(2, 0) * bF01 + F(2, 1) * r_F_00;
    A(0, 0, 2, 2) = F(2, 0) * bF02 + F(2, 2) * r_F_00;
    A(0, 1, 0, 1) = B00 + S11 + F(0, 1) * rb_F_01;
    A(0, 1, 0, 2) = S12 + F(0, 2) * rb_F_01;
    A(0, 1, 1, 0) = F(1, 0) * r_F_01 + F(1, 1) * bF00;
    A(0, 1, 1, 1) = B01 + F(1, 1) * rb_F_01;
    A(0, 1, 1, 2) = F(1, 1) * bF02 + F(1, 2) * r_F_01;
    A(0, 1, 2, 0) = F(2, 0) * r_F_01 + F(2, 1) * bF00;
    A(0, 1, 2, 1) = B02 + F(2, 1) * rb_F_01;
    A(0, 1, 2, 2) = F(2, 1) * bF02 + F(2, 2) * r_F_01;
    A(0, 2, 0, 2) = B00 + S22 + F(0, 2) * rb_F_02;
    A(0, 2, 1, 0) = F(1, 0) * r_F_02 + F(1, 2) * bF00;
    A(0, 2, 1, 1) = F(1, 1) * r_F_02 + F(1, 2) * bF01;
    A(0, 2, 1, 2) = B01 + F(1, 2) * rb_F_02;
    A(0, 2, 2, 0) = F(2, 0) * r_F_02 + F(2, 2) * bF00;
    A(0, 2, 2, 1) = F(2, 1) * r_F_02 + F(2, 2) * bF01;
    A(0, 2, 2, 2) = B02 + F(2, 2) * rb_F_02;
    A(1, 0, 1, 0) = B11 + S00 + F(1, 0) * rb_F_10;
    A(1, 0, 1, 1) = S01 + F(1, 1) * rb_F_10;
    A(1, 0, 1, 2) = S02 + F(1, 2) * rb_F_10;
    A(1, 0, 2, 0) = B12 + F(2, 0) * rb_F_10;
    A(1, 0, 2, 1) = F(2, 0) * bF11 + F(2, 1) * r_F_10;
    A(1, 0, 2, 2) = F(2, 0) * bF12 + F(2, 2) * r_F_10;
    A(1, 1, 1, 1) = B11 + S11 + F(1, 1) * rb_F_11;
    A(1, 1, 1, 2) = S12 + F(1, 2) * rb_F_11;
    A(1, 1, 2, 0) = F(2, 0) * r_F_11 + F(2, 1) * bF10;
    A(1, 1, 2, 1) = B12 + F(2, 1) * rb_F_11;
    A(1, 1, 2, 2) = F(2, 1) * bF12 + F(2, 2) * r_F_11;
    A(1, 2, 1, 2) = B11 + S22 + F(1, 2) * rb_F_12;
    A(1, 2, 2, 0) = F(2, 0) * r_F_12 + F(2, 2) * bF10;
    A(1, 2, 2, 1) = F(2, 1) * r_F_12 + F(2, 2) * bF11;
    A(1, 2, 2, 2) = B12 + F(2, 2) * rb_F_12;
    A(2, 0, 2, 0) = B22 + S00 + F(2, 0) * rb_F_20;
    A(2, 0, 2, 1) = S01 + F(2, 1) * rb_F_20;
    A(2, 0, 2, 2) = S02 + F(2, 2) * rb_F_20;
    A(2, 1, 2, 1) = B22 + S11 + F(2, 1) * rb_F_21;
    A(2, 1, 2, 2) = S12 + F(2, 2) * rb_F_21;
    A(2, 2, 2, 2) = B22 + S22 + F(2, 2) * rb_F_22;
    return A;
  }

  // The same of a sheet, F of 3 x 2, in axes whose first 2 lie in it.
  [[nodiscard]] T energy(const Columns<T, 2>& F) const {
    const T e01 = T(0.5) * F(0, 0) * F(0, 1) + T(0.5) * F(1, 0) * F(1, 1) + T(0.5) * F(2, 0) * F(2, 1);
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T e11 =
        T(0.5) * F(0, 1) * F(0, 1) + T(0.5) * F(1, 1) * F(1, 1) + T(0.5) * F(2, 1) * F(2, 1) - T(0.5);
    const T tr_E = e00 + e11;
    const T tr_E2 = e00 * e00 + e11 * e11 + T(2.0) * e01 * e01;
    const T W = mu * tr_E2 + T(0.5) * lambda * tr_E * tr_E;
    return W;
  }
  [[nodiscard]] Columns<T, 2> stress(const Columns<T, 2>& F) const {
    const T e01 = T(0.5) * F(0, 0) * F(0, 1) + T(0.5) * F(1, 0) * F(1, 1) + T(0.5) * F(2, 0) * F(2, 1);
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T e11 =
        T(0.5) * F(0, 1) * F(0, 1) + T(0.5) * F(1, 1) * F(1, 1) + T(0.5) * F(2, 1) * F(2, 1) - T(0.5);
    const T tr_E = e00 + e11;
    const T W_1 = lambda * tr_E;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    const T S11 = W_1 + T(2.0) * e11 * mu;
    const T S01 = T(2.0) * e01 * mu;
    Columns<T, 2> P;
    P(0, 0) = F(0, 0) * S00 + F(0, 1) * S01;
    P(0, 1) = F(0, 0) * S01 + F(0, 1) * S11;
    P(1, 0) = F(1, 0) * S00 + F(1, 1) * S01;
    P(1, 1) = F(1, 0) * S01 + F(1, 1) * S11;
    P(2, 0) = F(2, 0) * S00 + F(2, 1) * S01;
    P(2, 1) = F(2, 0) * S01 + F(2, 1) * S11;
    return P;
  }
  [[nodiscard]] Columns<T, 2> stress_change(const Columns<T, 2>& F, const Columns<T, 2>& dF) const {
    const T e01 = T(0.5) * F(0, 0) * F(0, 1) + T(0.5) * F(1, 0) * F(1, 1) + T(0.5) * F(2, 0) * F(2, 1);
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T e11 =
        T(0.5) * F(0, 1) * F(0, 1) + T(0.5) * F(1, 1) * F(1, 1) + T(0.5) * F(2, 1) * F(2, 1) - T(0.5);
    const T tr_E = e00 + e11;
    const T W_1 = lambda * tr_E;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    const T S11 = W_1 + T(2.0) * e11 * mu;
    const T S01 = T(2.0) * e01 * mu;
    const T D00 = F(0, 0) * dF(0, 0) + F(1, 0) * dF(1, 0) + F(2, 0) * dF(2, 0);
    const T D01 = F(0, 0) * dF(0, 1) + F(1, 0) * dF(1, 1) + F(2, 0) * dF(2, 1);
    const T D10 = F(0, 1) * dF(0, 0) + F(1, 1) * dF(1, 0) + F(2, 1) * dF(2, 0);
    const T D11 = F(0, 1) * dF(0, 1) + F(1, 1) * dF(1, 1) + F(2, 1) * dF(2, 1);
    const T de01 = T(0.5) * D01 + T(0.5) * D10;
    const T along_1 = D00 + D11;
    const T dW_1 = along_1 * lambda;
    const T T00 = dW_1 + T(2.0) * D00 * mu;
    const T T11 = dW_1 + T(2.0) * D11 * mu;
    const T T01 = T(2.0) * de01 * mu;
    Columns<T, 2> dP;
    dP(0, 0) = F(0, 0) * T00 + F(0, 1) * T01 + S00 * dF(0, 0) + S01 * dF(0, 1);
    dP(0, 1) = F(0, 0) * T01 + F(0, 1) * T11 + S01 * dF(0, 0) + S11 * dF(0, 1);
    dP(1, 0) = F(1, 0) * T00 + F(1, 1) * T01 + S00 * dF(1, 0) + S01 * dF(1, 1);
    dP(1, 1) = F(1, 0) * T01 + F(1, 1) * T11 + S01 * dF(1, 0) + S11 * dF(1, 1);
    dP(2, 0) = F(2, 0) * T00 + F(2, 1) * T01 + S00 * dF(2, 0) + S01 * dF(2, 1);
    dP(2, 1) = F(2, 0) * T01 + F(2, 1) * T11 + S01 * dF(2, 0) + S11 * dF(2, 1);
    return dP;
  }
  [[nodiscard]] ColumnsTangent<T, 2> tangent(const Columns<T, 2>& F) const {
    const T e01 = T(0.5) * F(0, 0) * F(0, 1) + T(0.5) * F(1, 0) * F(1, 1) + T(0.5) * F(2, 0) * F(2, 1);
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T e11 =
        T(0.5) * F(0, 1) * F(0, 1) + T(0.5) * F(1, 1) * F(1, 1) + T(0.5) * F(2, 1) * F(2, 1) - T(0.5);
    const T tr_E = e00 + e11;
    const T W_1 = lambda * tr_E;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    const T S11 = W_1 + T(2.0) * e11 * mu;
    const T S01 = T(2.0) * e01 * mu;
    const T b00 = mu * (F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1));
    const T b01 = mu * (F(0, 0) * F(1, 0) + F(0, 1) * F(1, 1));
    const T b02 = mu * (F(0, 0) * F(2, 0) + F(0, 1) * F(2, 1));
    const T b11 = mu * (F(1, 0) * F(1, 0) + F(1, 1) * F(1, 1));
    const T b12 = mu * (F(1, 0) * F(2, 0) + F(1, 1) * F(2, 1));
    const T b22 = mu * (F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1));
    ColumnsTangent<T, 2> A;
    A(0, 0, 0, 0) = S00 + b00 + lambda * F(0, 0) * F(0, 0) + mu * F(0, 0) * F(0, 0);
    A(0, 0, 0, 1) = S01 + F(0, 0) * F(0, 1) * lambda + F(0, 0) * F(0, 1) * mu;
    A(0, 0, 1, 0) = b01 + F(0, 0) * F(1, 0) * lambda + F(0, 0) * F(1, 0) * mu;
    A(0, 0, 1, 1) = F(0, 0) * F(1, 1) * lambda + F(0, 1) * F(1, 0) * mu;
    A(0, 0, 2, 0) = b02 + F(0, 0) * F(2, 0) * lambda + F(0, 0) * F(2, 0) * mu;
    A(0, 0, 2, 1) = F(0, 0) * F(2, 1) * lambda + F(0, 1) * F(2, 0) * mu;
    A(0, 1, 0, 1) = S11 + b00 + lambda * F(0, 1) * F(0, 1) + mu * F(0, 1) * F(0, 1);
    A(0, 1, 1, 0) = F(0, 0) * F(1, 1) * mu + F(0, 1) * F(1, 0) * lambda;
    A(0, 1, 1, 1) = b01 + F(0, 1) * F(1, 1) * lambda + F(0, 1) * F(1, 1) * mu;
    A(0, 1, 2, 0) = F(0, 0) * F(2, 1) * mu + F(0, 1) * F(2, 0) * lambda;
    A(0, 1, 2, 1) = b02 + F(0, 1) * F(2, 1) * lambda + F(0, 1) * F(2, 1) * mu;
    A(1, 0, 1, 0) = S00 + b11 + lambda * F(1, 0) * F(1, 0) + mu * F(1, 0) * F(1, 0);
    A(1, 0, 1, 1) = S01 + F(1, 0) * F(1, 1) * lambda + F(1, 0) * F(1, 1) * mu;
    A(1, 0, 2, 0) = b12 + F(1, 0) * F(2, 0) * lambda + F(1, 0) * F(2, 0) * mu;
    A(1, 0, 2, 1) = F(1, 0) * F(2, 1) * lambda + F(1, 1) * F(2, 0) * mu;
    A(1, 1, 1, 1) = S11 + b11 + lambda * F(1, 1) * F(1, 1) + mu * F(1, 1) * F(1, 1);
    A(1, 1, 2, 0) = F(1, 0) * F(2, 1) * mu + F(1, 1) * F(2, 0) * lambda;
    A(1, 1, 2, 1) = b12 + F(1, 1) * F(2, 1) * lambda + F(1, 1) * F(2, 1) * mu;
    A(2, 0, 2, 0) = S00 + b22 + lambda * F(2, 0) * F(2, 0) + mu * F(2, 0) * F(2, 0);
    A(2, 0, 2, 1) = S01 + F(2, 0) * F(2, 1) * lambda + F(2, 0) * F(2, 1) * mu;
    A(2, 1, 2, 1) = S11 + b22 + lambda * F(2, 1) * F(2, 1) + mu * F(2, 1) * F(2, 1);
    return A;
  }

  // The same of a line, F of 3 x 1, in axes whose first 1 lie in it.
  [[nodiscard]] T energy(const Columns<T, 1>& F) const {
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T tr_E = e00;
    const T tr_E2 = e00 * e00;
    const T W = mu * tr_E2 + T(0.5) * lambda * tr_E * tr_E;
    return W;
  }
  [[nodiscard]] Columns<T, 1> stress(const Columns<T, 1>& F) const {
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T tr_E = e00;
    const T W_1 = lambda * tr_E;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    Columns<T, 1> P;
    P(0, 0) = F(0, 0) * S00;
    P(1, 0) = F(1, 0) * S00;
    P(2, 0) = F(2, 0) * S00;
    return P;
  }
  [[nodiscard]] Columns<T, 1> stress_change(const Columns<T, 1>& F, const Columns<T, 1>& dF) const {
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T tr_E = e00;
    const T W_1 = lambda * tr_E;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    const T D00 = F(0, 0) * dF(0, 0) + F(1, 0) * dF(1, 0) + F(2, 0) * dF(2, 0);
    const T dW_1 = D00 * lambda;
    const T T00 = dW_1 + T(2.0) * D00 * mu;
    Columns<T, 1> dP;
    dP(0, 0) = F(0, 0) * T00 + S00 * dF(0, 0);
    dP(1, 0) = F(1, 0) * T00 + S00 * dF(1, 0);
    dP(2, 0) = F(2, 0) * T00 + S00 * dF(2, 0);
    return dP;
  }
  [[nodiscard]] ColumnsTangent<T, 1> tangent(const Columns<T, 1>& F) const {
    const T e00 =
        T(0.5) * F(0, 0) * F(0, 0) + T(0.5) * F(1, 0) * F(1, 0) + T(0.5) * F(2, 0) * F(2, 0) - T(0.5);
    const T tr_E = e00;
    const T W_1 = lambda * tr_E;
    const T S00 = W_1 + T(2.0) * e00 * mu;
    const T b00 = mu * F(0, 0) * F(0, 0);
    const T b01 = F(0, 0) * F(1, 0) * mu;
    const T b02 = F(0, 0) * F(2, 0) * mu;
    const T b11 = mu * F(1, 0) * F(1, 0);
    const T b12 = F(1, 0) * F(2, 0) * mu;
    const T b22 = mu * F(2, 0) * F(2, 0);
    ColumnsTangent<T, 1> A;
    A(0, 0, 0, 0) = S00 + b00 + lambda * F(0, 0) * F(0, 0) + mu * F(0, 0) * F(0, 0);
    A(0, 0, 1, 0) = b01 + F(0, 0) * F(1, 0) * lambda + F(0, 0) * F(1, 0) * mu;
    A(0, 0, 2, 0) = b02 + F(0, 0) * F(2, 0) * lambda + F(0, 0) * F(2, 0) * mu;
    A(1, 0, 1, 0) = S00 + b11 + lambda * F(1, 0) * F(1, 0) + mu * F(1, 0) * F(1, 0);
    A(1, 0, 2, 0) = b12 + F(1, 0) * F(2, 0) * lambda + F(1, 0) * F(2, 0) * mu;
    A(2, 0, 2, 0) = S00 + b22 + lambda * F(2, 0) * F(2, 0) + mu * F(2, 0) * F(2, 0);
    return A;
  }
};

}  // namespace tissu
