#pragma once

// Made from python/tissu/codegen/laws/mooney_rivlin.py
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <cmath>
#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// Mooney–Rivlin, nearly incompressible.
///
/// Mooney 1940, Rivlin 1948; Holzapfel, Nonlinear Solid Mechanics, 2000, section 6.5. Valid up to a
/// strain of about 100 %. c2 < 0 is accepted, but stable only at small strains.
///
///     W = c1 * (Ibar1 - 3) + c2 * (Ibar2 - 3) + kappa / 2 * (J - 1) ** 2
///
/// Operations:
/// - energy: 45 multiplications, 30 additions, 1 division, cbrt
/// - stress: 109 multiplications, 65 additions, 1 division, cbrt
/// - stress_change: 252 multiplications, 182 additions, 1 division, cbrt
/// - tangent: 342 multiplications, 243 additions, 1 division, cbrt
template <class T>
struct MooneyRivlin {
  static constexpr std::string_view kName = "mooney_rivlin";
  static constexpr bool kLinear = false;         ///< one tangent serves every F
  static constexpr bool kFrameInvariant = true;  ///< blind to rotation
  static constexpr bool kIsotropic = true;       ///< blind to the axes of the rest shape
  static constexpr bool kHomogeneous = true;     ///< in proportion to its constants
  static constexpr bool kAddition = false;       ///< to be added to a base law
  T c1;
  T c2;
  T kappa;

  /// W [J/m3]
  [[nodiscard]] T energy(const Tensor2<T>& F) const {
    using std::cbrt;
    const T K00 = F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1);
    const T K01 = F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2);
    const T K02 = F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0);
    const T J = F(0, 0) * K00 + F(0, 1) * K01 + F(0, 2) * K02;
    const T root = T(1.0) / cbrt(J);
    const T J_23 = root * root;
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T I_C = C00 + C11 + C22;
    const T Ibar1 = I_C * J_23;
    const T off_diagonal = C01 * C01 + C02 * C02 + C12 * C12;
    const T tr_C2 = C00 * C00 + C11 * C11 + C22 * C22 + T(2.0) * off_diagonal;
    const T twice_II_C = I_C * I_C - tr_C2;
    const T II_C = T(0.5) * twice_II_C;
    const T Ibar2 = II_C * J_23 * J_23;
    const T x0 = J - T(1.0);
    const T W = c1 * (Ibar1 - T(3.0)) + c2 * (Ibar2 - T(3.0)) + T(0.5) * kappa * x0 * x0;
    return W;
  }

  /// P = dW/dF [Pa]
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    using std::cbrt;
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T I_C = C00 + C11 + C22;
    const T K00 = F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1);
    const T K01 = F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2);
    const T K02 = F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0);
    const T K10 = F(0, 2) * F(2, 1) - F(0, 1) * F(2, 2);
    const T K11 = F(0, 0) * F(2, 2) - F(0, 2) * F(2, 0);
    const T K12 = F(0, 1) * F(2, 0) - F(0, 0) * F(2, 1);
    const T K20 = F(0, 1) * F(1, 2) - F(0, 2) * F(1, 1);
    const T K21 = F(0, 2) * F(1, 0) - F(0, 0) * F(1, 2);
    const T K22 = F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
    const T J = F(0, 0) * K00 + F(0, 1) * K01 + F(0, 2) * K02;
    const T root = T(1.0) / cbrt(J);
    const T J_23 = root * root;
    const T Ibar1 = I_C * J_23;
    const T off_diagonal = C01 * C01 + C02 * C02 + C12 * C12;
    const T tr_C2 = C00 * C00 + C11 * C11 + C22 * C22 + T(2.0) * off_diagonal;
    const T twice_II_C = I_C * I_C - tr_C2;
    const T II_C = T(0.5) * twice_II_C;
    const T Ibar2 = II_C * J_23 * J_23;
    const T J_inv = J_23 * root;
    const T p_F = T(2.0) * J_23 * (c1 + I_C * J_23 * c2);
    const T p_FC = -T(2.0) * c2 * J_23 * J_23;
    const T p_K =
        kappa * (J - T(1.0)) - T(4.0 / 3.0) * Ibar2 * J_inv * c2 - T(2.0 / 3.0) * Ibar1 * J_inv * c1;
    const T S00 = p_F + C00 * p_FC;
    const T S01 = C01 * p_FC;
    const T S02 = C02 * p_FC;
    const T S11 = p_F + C11 * p_FC;
    const T S12 = C12 * p_FC;
    const T S22 = p_F + C22 * p_FC;
    Tensor2<T> P;
    P(0, 0) = F(0, 0) * S00 + F(0, 1) * S01 + F(0, 2) * S02 + K00 * p_K;
    P(0, 1) = F(0, 0) * S01 + F(0, 1) * S11 + F(0, 2) * S12 + K01 * p_K;
    P(0, 2) = F(0, 0) * S02 + F(0, 1) * S12 + F(0, 2) * S22 + K02 * p_K;
    P(1, 0) = F(1, 0) * S00 + F(1, 1) * S01 + F(1, 2) * S02 + K10 * p_K;
    P(1, 1) = F(1, 0) * S01 + F(1, 1) * S11 + F(1, 2) * S12 + K11 * p_K;
    P(1, 2) = F(1, 0) * S02 + F(1, 1) * S12 + F(1, 2) * S22 + K12 * p_K;
    P(2, 0) = F(2, 0) * S00 + F(2, 1) * S01 + F(2, 2) * S02 + K20 * p_K;
    P(2, 1) = F(2, 0) * S01 + F(2, 1) * S11 + F(2, 2) * S12 + K21 * p_K;
    P(2, 2) = F(2, 0) * S02 + F(2, 1) * S12 + F(2, 2) * S22 + K22 * p_K;
    return P;
  }

  /// dP = dP/dF : dF [Pa]
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
    using std::cbrt;
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T I_C = C00 + C11 + C22;
    const T K00 = F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1);
    const T K01 = F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2);
    const T K02 = F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0);
    const T K10 = F(0, 2) * F(2, 1) - F(0, 1) * F(2, 2);
    const T K11 = F(0, 0) * F(2, 2) - F(0, 2) * F(2, 0);
    const T K12 = F(0, 1) * F(2, 0) - F(0, 0) * F(2, 1);
    const T K20 = F(0, 1) * F(1, 2) - F(0, 2) * F(1, 1);
    const T K21 = F(0, 2) * F(1, 0) - F(0, 0) * F(1, 2);
    const T K22 = F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
    const T J = F(0, 0) * K00 + F(0, 1) * K01 + F(0, 2) * K02;
    const T root = T(1.0) / cbrt(J);
    const T J_23 = root * root;
    const T Ibar1 = I_C * J_23;
    const T off_diagonal = C01 * C01 + C02 * C02 + C12 * C12;
    const T tr_C2 = C00 * C00 + C11 * C11 + C22 * C22 + T(2.0) * off_diagonal;
    const T twice_II_C = I_C * I_C - tr_C2;
    const T II_C = T(0.5) * twice_II_C;
    const T Ibar2 = II_C * J_23 * J_23;
    const T J_inv = J_23 * root;
    const T x0 = I_C * J_23 * c2;
    const T x1 = c2 * J_23 * J_23;
    const T x2 = Ibar1 * c1;
    const T x3 = Ibar2 * c2;
    const T x4 = T(4.0 / 3.0) * J_inv;
    const T p_F = T(2.0) * J_23 * (c1 + x0);
    const T p_FC = -T(2.0) * x1;
    const T p_K = kappa * (J - T(1.0)) - x3 * x4 - T(2.0 / 3.0) * J_inv * x2;
    const T m_F_F = T(4.0) * x1;
    const T m_F_K = -J_23 * x4 * (c1 + T(2.0) * x0);
    const T m_FC_K = T(8.0 / 3.0) * J_inv * x1;
    const T m_K_K = kappa + J_inv * J_inv * (T(10.0 / 9.0) * x2 + T(28.0 / 9.0) * x3);
    const T S00 = p_F + C00 * p_FC;
    const T S01 = C01 * p_FC;
    const T S02 = C02 * p_FC;
    const T S11 = p_F + C11 * p_FC;
    const T S12 = C12 * p_FC;
    const T S22 = p_F + C22 * p_FC;
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
    const T along_FC =
        C00 * D00 + C01 * (D01 + D10) + C02 * (D02 + D20) + C11 * D11 + C12 * (D12 + D21) + C22 * D22;
    const T along_K = K00 * dF(0, 0) + K01 * dF(0, 1) + K02 * dF(0, 2) + K10 * dF(1, 0) + K11 * dF(1, 1) +
                      K12 * dF(1, 2) + K20 * dF(2, 0) + K21 * dF(2, 1) + K22 * dF(2, 2);
    const T dp_F = along_F * m_F_F + along_K * m_F_K;
    const T dp_FC = along_K * m_FC_K;
    const T dp_K = along_F * m_F_K + along_FC * m_FC_K + along_K * m_K_K;
    const T twice_p_FC = T(2.0) * p_FC;
    const T D01s = D01 + D10;
    const T D02s = D02 + D20;
    const T D12s = D12 + D21;
    const T T00 = dp_F + C00 * dp_FC + D00 * twice_p_FC;
    const T T01 = C01 * dp_FC + D01s * p_FC;
    const T T02 = C02 * dp_FC + D02s * p_FC;
    const T T11 = dp_F + C11 * dp_FC + D11 * twice_p_FC;
    const T T12 = C12 * dp_FC + D12s * p_FC;
    const T T22 = dp_F + C22 * dp_FC + D22 * twice_p_FC;
    const T dK00 = F(1, 1) * dF(2, 2) + F(2, 2) * dF(1, 1) - F(1, 2) * dF(2, 1) - F(2, 1) * dF(1, 2);
    const T dK01 = F(1, 2) * dF(2, 0) + F(2, 0) * dF(1, 2) - F(1, 0) * dF(2, 2) - F(2, 2) * dF(1, 0);
    const T dK02 = F(1, 0) * dF(2, 1) + F(2, 1) * dF(1, 0) - F(1, 1) * dF(2, 0) - F(2, 0) * dF(1, 1);
    const T dK10 = F(0, 2) * dF(2, 1) + F(2, 1) * dF(0, 2) - F(0, 1) * dF(2, 2) - F(2, 2) * dF(0, 1);
    const T dK11 = F(0, 0) * dF(2, 2) + F(2, 2) * dF(0, 0) - F(0, 2) * dF(2, 0) - F(2, 0) * dF(0, 2);
    const T dK12 = F(0, 1) * dF(2, 0) + F(2, 0) * dF(0, 1) - F(0, 0) * dF(2, 1) - F(2, 1) * dF(0, 0);
    const T dK20 = F(0, 1) * dF(1, 2) + F(1, 2) * dF(0, 1) - F(0, 2) * dF(1, 1) - F(1, 1) * dF(0, 2);
    const T dK21 = F(0, 2) * dF(1, 0) + F(1, 0) * dF(0, 2) - F(0, 0) * dF(1, 2) - F(1, 2) * dF(0, 0);
    const T dK22 = F(0, 0) * dF(1, 1) + F(1, 1) * dF(0, 0) - F(0, 1) * dF(1, 0) - F(1, 0) * dF(0, 1);
    Tensor2<T> dP;
    dP(0, 0) = Q00 + F(0, 0) * T00 + F(0, 1) * T01 + F(0, 2) * T02 + K00 * dp_K + dK00 * p_K;
    dP(0, 1) = Q01 + F(0, 0) * T01 + F(0, 1) * T11 + F(0, 2) * T12 + K01 * dp_K + dK01 * p_K;
    dP(0, 2) = Q02 + F(0, 0) * T02 + F(0, 1) * T12 + F(0, 2) * T22 + K02 * dp_K + dK02 * p_K;
    dP(1, 0) = Q10 + F(1, 0) * T00 + F(1, 1) * T01 + F(1, 2) * T02 + K10 * dp_K + dK10 * p_K;
    dP(1, 1) = Q11 + F(1, 0) * T01 + F(1, 1) * T11 + F(1, 2) * T12 + K11 * dp_K + dK11 * p_K;
    dP(1, 2) = Q12 + F(1, 0) * T02 + F(1, 1) * T12 + F(1, 2) * T22 + K12 * dp_K + dK12 * p_K;
    dP(2, 0) = Q20 + F(2, 0) * T00 + F(2, 1) * T01 + F(2, 2) * T02 + K20 * dp_K + dK20 * p_K;
    dP(2, 1) = Q21 + F(2, 0) * T01 + F(2, 1) * T11 + F(2, 2) * T12 + K21 * dp_K + dK21 * p_K;
    dP(2, 2) = Q22 + F(2, 0) * T02 + F(2, 1) * T12 + F(2, 2) * T22 + K22 * dp_K + dK22 * p_K;
    return dP;
  }

  /// dP/dF, upper triangle [Pa]
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
    using std::cbrt;
    const T C00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0) + F(2, 0) * F(2, 0);
    const T C01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1) + F(2, 0) * F(2, 1);
    const T C02 = F(0, 0) * F(0, 2) + F(1, 0) * F(1, 2) + F(2, 0) * F(2, 2);
    const T C11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1) + F(2, 1) * F(2, 1);
    const T C12 = F(0, 1) * F(0, 2) + F(1, 1) * F(1, 2) + F(2, 1) * F(2, 2);
    const T C22 = F(0, 2) * F(0, 2) + F(1, 2) * F(1, 2) + F(2, 2) * F(2, 2);
    const T I_C = C00 + C11 + C22;
    const T K00 = F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1);
    const T K01 = F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2);
    const T K02 = F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0);
    const T K10 = F(0, 2) * F(2, 1) - F(0, 1) * F(2, 2);
    const T K11 = F(0, 0) * F(2, 2) - F(0, 2) * F(2, 0);
    const T K12 = F(0, 1) * F(2, 0) - F(0, 0) * F(2, 1);
    const T K20 = F(0, 1) * F(1, 2) - F(0, 2) * F(1, 1);
    const T K21 = F(0, 2) * F(1, 0) - F(0, 0) * F(1, 2);
    const T K22 = F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
    const T J = F(0, 0) * K00 + F(0, 1) * K01 + F(0, 2) * K02;
    const T root = T(1.0) / cbrt(J);
    const T J_23 = root * root;
    const T Ibar1 = I_C * J_23;
    const T off_diagonal = C01 * C01 + C02 * C02 + C12 * C12;
    const T tr_C2 = C00 * C00 + C11 * C11 + C22 * C22 + T(2.0) * off_diagonal;
    const T twice_II_C = I_C * I_C - tr_C2;
    const T II_C = T(0.5) * twice_II_C;
    const T Ibar2 = II_C * J_23 * J_23;
    const T J_inv = J_23 * root;
    const T x0 = I_C * J_23 * c2;
    const T x1 = c2 * J_23 * J_23;
    const T x2 = Ibar1 * c1;
    const T x3 = Ibar2 * c2;
    const T x4 = T(4.0 / 3.0) * J_inv;
    const T p_F = T(2.0) * J_23 * (c1 + x0);
    const T p_FC = -T(2.0) * x1;
    const T p_K = kappa * (J - T(1.0)) - x3 * x4 - T(2.0 / 3.0) * J_inv * x2;
    const T m_F_F = T(4.0) * x1;
    const T m_F_K = -J_23 * x4 * (c1 + T(2.0) * x0);
    const T m_FC_K = T(8.0 / 3.0) * J_inv * x1;
    const T m_K_K = kappa + J_inv * J_inv * (T(10.0 / 9.0) * x2 + T(28.0 / 9.0) * x3);
    const T half_m_K_K = T(0.5) * m_K_K;
    const T FC00 = C00 * F(0, 0) + C01 * F(0, 1) + C02 * F(0, 2);
    const T FC01 = C01 * F(0, 0) + C11 * F(0, 1) + C12 * F(0, 2);
    const T FC02 = C02 * F(0, 0) + C12 * F(0, 1) + C22 * F(0, 2);
    const T FC10 = C00 * F(1, 0) + C01 * F(1, 1) + C02 * F(1, 2);
    const T FC11 = C01 * F(1, 0) + C11 * F(1, 1) + C12 * F(1, 2);
    const T FC12 = C02 * F(1, 0) + C12 * F(1, 1) + C22 * F(1, 2);
    const T FC20 = C00 * F(2, 0) + C01 * F(2, 1) + C02 * F(2, 2);
    const T FC21 = C01 * F(2, 0) + C11 * F(2, 1) + C12 * F(2, 2);
    const T FC22 = C02 * F(2, 0) + C12 * F(2, 1) + C22 * F(2, 2);
    const T q_K_00 = F(0, 0) * m_F_K + FC00 * m_FC_K + K00 * half_m_K_K;
    const T q_K_01 = F(0, 1) * m_F_K + FC01 * m_FC_K + K01 * half_m_K_K;
    const T q_K_02 = F(0, 2) * m_F_K + FC02 * m_FC_K + K02 * half_m_K_K;
    const T q_K_10 = F(1, 0) * m_F_K + FC10 * m_FC_K + K10 * half_m_K_K;
    const T q_K_11 = F(1, 1) * m_F_K + FC11 * m_FC_K + K11 * half_m_K_K;
    const T q_K_12 = F(1, 2) * m_F_K + FC12 * m_FC_K + K12 * half_m_K_K;
    const T q_K_20 = F(2, 0) * m_F_K + FC20 * m_FC_K + K20 * half_m_K_K;
    const T q_K_21 = F(2, 1) * m_F_K + FC21 * m_FC_K + K21 * half_m_K_K;
    const T q_K_22 = F(2, 2) * m_F_K + FC22 * m_FC_K + K22 * half_m_K_K;
    const T r_F_00 = F(0, 0) * m_F_F;
    const T r_F_01 = F(0, 1) * m_F_F;
    const T r_F_02 = F(0, 2) * m_F_F;
    const T r_F_10 = F(1, 0) * m_F_F;
    const T r_F_11 = F(1, 1) * m_F_F;
    const T r_F_12 = F(1, 2) * m_F_F;
    const T m_F_F_p_FC = m_F_F + p_FC;
    const T rb_F_00 = F(0, 0) * m_F_F_p_FC;
    const T rb_F_01 = F(0, 1) * m_F_F_p_FC;
    const T rb_F_02 = F(0, 2) * m_F_F_p_FC;
    const T rb_F_10 = F(1, 0) * m_F_F_p_FC;
    const T rb_F_11 = F(1, 1) * m_F_F_p_FC;
    const T rb_F_12 = F(1, 2) * m_F_F_p_FC;
    const T rb_F_20 = F(2, 0) * m_F_F_p_FC;
    const T rb_F_21 = F(2, 1) * m_F_F_p_FC;
    const T rb_F_22 = F(2, 2) * m_F_F_p_FC;
    const T S00 = p_F + C00 * p_FC;
    const T S01 = C01 * p_FC;
    const T S02 = C02 * p_FC;
    const T S11 = p_F + C11 * p_FC;
    const T S12 = C12 * p_FC;
    const T S22 = p_F + C22 * p_FC;
    const T bF00 = F(0, 0) * p_FC;
    const T bF01 = F(0, 1) * p_FC;
    const T bF02 = F(0, 2) * p_FC;
    const T bF10 = F(1, 0) * p_FC;
    const T bF11 = F(1, 1) * p_FC;
    const T bF12 = F(1, 2) * p_FC;
    const T bF20 = F(2, 0) * p_FC;
    const T bF21 = F(2, 1) * p_FC;
    const T bF22 = F(2, 2) * p_FC;
    const T B00 = F(0, 0) * bF00 + F(0, 1) * bF01 + F(0, 2) * bF02;
    const T B01 = F(1, 0) * bF00 + F(1, 1) * bF01 + F(1, 2) * bF02;
    const T B02 = F(2, 0) * bF00 + F(2, 1) * bF01 + F(2, 2) * bF02;
    const T B11 = F(1, 0) * bF10 + F(1, 1) * bF11 + F(1, 2) * bF12;
    const T B12 = F(2, 0) * bF10 + F(2, 1) * bF11 + F(2, 2) * bF12;
    const T B22 = F(2, 0) * bF20 + F(2, 1) * bF21 + F(2, 2) * bF22;
    const T kF00 = F(0, 0) * p_K;
    const T kF01 = F(0, 1) * p_K;
    const T kF02 = F(0, 2) * p_K;
    const T kF10 = F(1, 0) * p_K;
    const T kF11 = F(1, 1) * p_K;
    const T kF12 = F(1, 2) * p_K;
    const T kF20 = F(2, 0) * p_K;
    const T kF21 = F(2, 1) * p_K;
    const T kF22 = F(2, 2) * p_K;
    Tangent<T> A;
    A(0, 0, 0, 0) = B00 + S00 + F(0, 0) * rb_F_00 + T(2.0) * K00 * q_K_00;
    A(0, 0, 0, 1) = S01 + F(0, 1) * rb_F_00 + K00 * q_K_01 + K01 * q_K_00;
    A(0, 0, 0, 2) = S02 + F(0, 2) * rb_F_00 + K00 * q_K_02 + K02 * q_K_00;
    A(0, 0, 1, 0) = B01 + F(1, 0) * rb_F_00 + K00 * q_K_10 + K10 * q_K_00;
    A(0, 0, 1, 1) = kF22 + F(1, 0) * bF01 + F(1, 1) * r_F_00 + K00 * q_K_11 + K11 * q_K_00;
    A(0, 0, 1, 2) = F(1, 0) * bF02 + F(1, 2) * r_F_00 + K00 * q_K_12 + K12 * q_K_00 - kF21;
    A(0, 0, 2, 0) = B02 + F(2, 0) * rb_F_00 + K00 * q_K_20 + K20 * q_K_00;
    A(0, 0, 2, 1) = F(2, 0) * bF01 + F(2, 1) * r_F_00 + K00 * q_K_21 + K21 * q_K_00 - kF12;
    A(0, 0, 2, 2) = kF11 + F(2, 0) * bF02 + F(2, 2) * r_F_00 + K00 * q_K_22 + K22 * q_K_00;
    A(0, 1, 0, 1) = B00 + S11 + F(0, 1) * rb_F_01 + T(2.0) * K01 * q_K_01;
    A(0, 1, 0, 2) = S12 + F(0, 2) * rb_F_01 + K01 * q_K_02 + K02 * q_K_01;
    A(0, 1, 1, 0) = F(1, 0) * r_F_01 + F(1, 1) * bF00 + K01 * q_K_10 + K10 * q_K_01 - kF22;
    A(0, 1, 1, 1) = B01 + F(1, 1) * rb_F_01 + K01 * q_K_11 + K11 * q_K_01;
    A(0, 1, 1, 2) = kF20 + F(1, 1) * bF02 + F(1, 2) * r_F_01 + K01 * q_K_12 + K12 * q_K_01;
    A(0, 1, 2, 0) = kF12 + F(2, 0) * r_F_01 + F(2, 1) * bF00 + K01 * q_K_20 + K20 * q_K_01;
    A(0, 1, 2, 1) = B02 + F(2, 1) * rb_F_01 + K01 * q_K_21 + K21 * q_K_01;
    A(0, 1, 2, 2) = F(2, 1) * bF02 + F(2, 2) * r_F_01 + K01 * q_K_22 + K22 * q_K_01 - kF10;
    A(0, 2, 0, 2) = B00 + S22 + F(0, 2) * rb_F_02 + T(2.0) * K02 * q_K_02;
    A(0, 2, 1, 0) = kF21 + F(1, 0) * r_F_02 + F(1, 2) * bF00 + K02 * q_K_10 + K10 * q_K_02;
    A(0, 2, 1, 1) = F(1, 1) * r_F_02 + F(1, 2) * bF01 + K02 * q_K_11 + K11 * q_K_02 - kF20;
    A(0, 2, 1, 2) = B01 + F(1, 2) * rb_F_02 + K02 * q_K_12 + K12 * q_K_02;
    A(0, 2, 2, 0) = F(2, 0) * r_F_02 + F(2, 2) * bF00 + K02 * q_K_20 + K20 * q_K_02 - kF11;
    A(0, 2, 2, 1) = kF10 + F(2, 1) * r_F_02 + F(2, 2) * bF01 + K02 * q_K_21 + K21 * q_K_02;
    A(0, 2, 2, 2) = B02 + F(2, 2) * rb_F_02 + K02 * q_K_22 + K22 * q_K_02;
    A(1, 0, 1, 0) = B11 + S00 + F(1, 0) * rb_F_10 + T(2.0) * K10 * q_K_10;
    A(1, 0, 1, 1) = S01 + F(1, 1) * rb_F_10 + K10 * q_K_11 + K11 * q_K_10;
    A(1, 0, 1, 2) = S02 + F(1, 2) * rb_F_10 + K10 * q_K_12 + K12 * q_K_10;
    A(1, 0, 2, 0) = B12 + F(2, 0) * rb_F_10 + K10 * q_K_20 + K20 * q_K_10;
    A(1, 0, 2, 1) = kF02 + F(2, 0) * bF11 + F(2, 1) * r_F_10 + K10 * q_K_21 + K21 * q_K_10;
    A(1, 0, 2, 2) = F(2, 0) * bF12 + F(2, 2) * r_F_10 + K10 * q_K_22 + K22 * q_K_10 - kF01;
    A(1, 1, 1, 1) = B11 + S11 + F(1, 1) * rb_F_11 + T(2.0) * K11 * q_K_11;
    A(1, 1, 1, 2) = S12 + F(1, 2) * rb_F_11 + K11 * q_K_12 + K12 * q_K_11;
    A(1, 1, 2, 0) = F(2, 0) * r_F_11 + F(2, 1) * bF10 + K11 * q_K_20 + K20 * q_K_11 - kF02;
    A(1, 1, 2, 1) = B12 + F(2, 1) * rb_F_11 + K11 * q_K_21 + K21 * q_K_11;
    A(1, 1, 2, 2) = kF00 + F(2, 1) * bF12 + F(2, 2) * r_F_11 + K11 * q_K_22 + K22 * q_K_11;
    A(1, 2, 1, 2) = B11 + S22 + F(1, 2) * rb_F_12 + T(2.0) * K12 * q_K_12;
    A(1, 2, 2, 0) = kF01 + F(2, 0) * r_F_12 + F(2, 2) * bF10 + K12 * q_K_20 + K20 * q_K_12;
    A(1, 2, 2, 1) = F(2, 1) * r_F_12 + F(2, 2) * bF11 + K12 * q_K_21 + K21 * q_K_12 - kF00;
    A(1, 2, 2, 2) = B12 + F(2, 2) * rb_F_12 + K12 * q_K_22 + K22 * q_K_12;
    A(2, 0, 2, 0) = B22 + S00 + F(2, 0) * rb_F_20 + T(2.0) * K20 * q_K_20;
    A(2, 0, 2, 1) = S01 + F(2, 1) * rb_F_20 + K20 * q_K_21 + K21 * q_K_20;
    A(2, 0, 2, 2) = S02 + F(2, 2) * rb_F_20 + K20 * q_K_22 + K22 * q_K_20;
    A(2, 1, 2, 1) = B22 + S11 + F(2, 1) * rb_F_21 + T(2.0) * K21 * q_K_21;
    A(2, 1, 2, 2) = S12 + F(2, 2) * rb_F_21 + K21 * q_K_22 + K22 * q_K_21;
    A(2, 2, 2, 2) = B22 + S22 + F(2, 2) * rb_F_22 + T(2.0) * K22 * q_K_22;
    return A;
  }
};

}  // namespace tissu
