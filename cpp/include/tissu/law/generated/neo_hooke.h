#pragma once

// Made from python/tissu/codegen/laws/neo_hooke.py
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <cmath>
#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// Compressible neo-Hooke with a barrier against lost volume.
///
/// Bonet, Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. 2008, eq. 6.28.
/// Valid up to about 50 % of strain. J must stay positive, or the energy is undefined.
///
///     W = mu / 2 * (I_C - 3) - mu * ln(J) + lam / 2 * ln(J) ** 2
///
/// Operations:
/// - energy: 24 multiplications, 16 additions, log
/// - stress: 41 multiplications, 21 additions, 1 division, log
/// - stress_change: 98 multiplications, 67 additions, 1 division, log
/// - tangent: 88 multiplications, 41 additions, 1 division, log
template <class T>
struct NeoHooke {
  static constexpr std::string_view kName = "neo_hooke";
  static constexpr bool kLinear = false;         ///< one tangent serves every F
  static constexpr bool kFrameInvariant = true;  ///< blind to rotation
  static constexpr bool kIsotropic = true;       ///< blind to the axes of the rest shape
  static constexpr bool kHomogeneous = true;     ///< in proportion to its constants
  static constexpr bool kAddition = false;       ///< to be added to a base law
  T lambda;                                      ///< poisson*young/((1 - 2*poisson)*(poisson + 1))
  T mu;                                          ///< young/(2*poisson + 2)

  /// W [J/m3]
  [[nodiscard]] T energy(const Tensor2<T>& F) const {
    using std::log;
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
    const T K00 = F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1);
    const T K01 = F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2);
    const T K02 = F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0);
    const T J = F(0, 0) * K00 + F(0, 1) * K01 + F(0, 2) * K02;
    const T x0 = log(J);
    const T W = T(0.5) * lambda * x0 * x0 + T(0.5) * mu * (I_C - T(3.0)) - mu * x0;
    return W;
  }

  /// P = dW/dF [Pa]
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    using std::log;
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
    const T J_inv = T(1.0) / J;
    const T p_K = J_inv * (lambda * log(J) - mu);
    Tensor2<T> P;
    P(0, 0) = F(0, 0) * mu + K00 * p_K;
    P(0, 1) = F(0, 1) * mu + K01 * p_K;
    P(0, 2) = F(0, 2) * mu + K02 * p_K;
    P(1, 0) = F(1, 0) * mu + K10 * p_K;
    P(1, 1) = F(1, 1) * mu + K11 * p_K;
    P(1, 2) = F(1, 2) * mu + K12 * p_K;
    P(2, 0) = F(2, 0) * mu + K20 * p_K;
    P(2, 1) = F(2, 1) * mu + K21 * p_K;
    P(2, 2) = F(2, 2) * mu + K22 * p_K;
    return P;
  }

  /// dP = dP/dF : dF [Pa]
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
    using std::log;
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
    const T J_inv = T(1.0) / J;
    const T x0 = lambda * log(J);
    const T p_K = J_inv * (x0 - mu);
    const T m_K_K = J_inv * J_inv * (lambda + mu - x0);
    const T along_K = K00 * dF(0, 0) + K01 * dF(0, 1) + K02 * dF(0, 2) + K10 * dF(1, 0) + K11 * dF(1, 1) +
                      K12 * dF(1, 2) + K20 * dF(2, 0) + K21 * dF(2, 1) + K22 * dF(2, 2);
    const T dp_K = along_K * m_K_K;
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
    dP(0, 0) = K00 * dp_K + dF(0, 0) * mu + dK00 * p_K;
    dP(0, 1) = K01 * dp_K + dF(0, 1) * mu + dK01 * p_K;
    dP(0, 2) = K02 * dp_K + dF(0, 2) * mu + dK02 * p_K;
    dP(1, 0) = K10 * dp_K + dF(1, 0) * mu + dK10 * p_K;
    dP(1, 1) = K11 * dp_K + dF(1, 1) * mu + dK11 * p_K;
    dP(1, 2) = K12 * dp_K + dF(1, 2) * mu + dK12 * p_K;
    dP(2, 0) = K20 * dp_K + dF(2, 0) * mu + dK20 * p_K;
    dP(2, 1) = K21 * dp_K + dF(2, 1) * mu + dK21 * p_K;
    dP(2, 2) = K22 * dp_K + dF(2, 2) * mu + dK22 * p_K;
    return dP;
  }

  /// dP/dF, upper triangle [Pa]
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
    using std::log;
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
    const T J_inv = T(1.0) / J;
    const T x0 = lambda * log(J);
    const T p_K = J_inv * (x0 - mu);
    const T m_K_K = J_inv * J_inv * (lambda + mu - x0);
    const T r_K_00 = K00 * m_K_K;
    const T r_K_01 = K01 * m_K_K;
    const T r_K_02 = K02 * m_K_K;
    const T r_K_10 = K10 * m_K_K;
    const T r_K_11 = K11 * m_K_K;
    const T r_K_12 = K12 * m_K_K;
    const T r_K_20 = K20 * m_K_K;
    const T r_K_21 = K21 * m_K_K;
    const T r_K_22 = K22 * m_K_K;
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
    A(0, 0, 0, 0) = mu + K00 * r_K_00;
    A(0, 0, 0, 1) = K01 * r_K_00;
    A(0, 0, 0, 2) = K02 * r_K_00;
    A(0, 0, 1, 0) = K10 * r_K_00;
    A(0, 0, 1, 1) = kF22 + K11 * r_K_00;
    A(0, 0, 1, 2) = K12 * r_K_00 - kF21;
    A(0, 0, 2, 0) = K20 * r_K_00;
    A(0, 0, 2, 1) = K21 * r_K_00 - kF12;
    A(0, 0, 2, 2) = kF11 + K22 * r_K_00;
    A(0, 1, 0, 1) = mu + K01 * r_K_01;
    A(0, 1, 0, 2) = K02 * r_K_01;
    A(0, 1, 1, 0) = K10 * r_K_01 - kF22;
    A(0, 1, 1, 1) = K11 * r_K_01;
    A(0, 1, 1, 2) = kF20 + K12 * r_K_01;
    A(0, 1, 2, 0) = kF12 + K20 * r_K_01;
    A(0, 1, 2, 1) = K21 * r_K_01;
    A(0, 1, 2, 2) = K22 * r_K_01 - kF10;
    A(0, 2, 0, 2) = mu + K02 * r_K_02;
    A(0, 2, 1, 0) = kF21 + K10 * r_K_02;
    A(0, 2, 1, 1) = K11 * r_K_02 - kF20;
    A(0, 2, 1, 2) = K12 * r_K_02;
    A(0, 2, 2, 0) = K20 * r_K_02 - kF11;
    A(0, 2, 2, 1) = kF10 + K21 * r_K_02;
    A(0, 2, 2, 2) = K22 * r_K_02;
    A(1, 0, 1, 0) = mu + K10 * r_K_10;
    A(1, 0, 1, 1) = K11 * r_K_10;
    A(1, 0, 1, 2) = K12 * r_K_10;
    A(1, 0, 2, 0) = K20 * r_K_10;
    A(1, 0, 2, 1) = kF02 + K21 * r_K_10;
    A(1, 0, 2, 2) = K22 * r_K_10 - kF01;
    A(1, 1, 1, 1) = mu + K11 * r_K_11;
    A(1, 1, 1, 2) = K12 * r_K_11;
    A(1, 1, 2, 0) = K20 * r_K_11 - kF02;
    A(1, 1, 2, 1) = K21 * r_K_11;
    A(1, 1, 2, 2) = kF00 + K22 * r_K_11;
    A(1, 2, 1, 2) = mu + K12 * r_K_12;
    A(1, 2, 2, 0) = kF01 + K20 * r_K_12;
    A(1, 2, 2, 1) = K21 * r_K_12 - kF00;
    A(1, 2, 2, 2) = K22 * r_K_12;
    A(2, 0, 2, 0) = mu + K20 * r_K_20;
    A(2, 0, 2, 1) = K21 * r_K_20;
    A(2, 0, 2, 2) = K22 * r_K_20;
    A(2, 1, 2, 1) = mu + K21 * r_K_21;
    A(2, 1, 2, 2) = K22 * r_K_21;
    A(2, 2, 2, 2) = mu + K22 * r_K_22;
    return A;
  }
};

}  // namespace tissu
