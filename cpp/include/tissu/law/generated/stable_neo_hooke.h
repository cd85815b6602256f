#pragma once

// Made from python/tissu/codegen/laws/stable_neo_hooke.py
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <cmath>
#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// Stable neo-Hooke: finite at every F, inverted and flattened elements included.
///
/// Smith, de Goes, Kim, Stable Neo-Hookean Flesh Simulation, ACM Trans. Graph. 37(2), 2018, with
/// their map of Lamé's constants, so that the limit of small strain is Hooke's law, and the energy
/// shifted to vanish at rest. It holds volume less strictly than neo-Hooke in compression.
///
///     W = mu_s / 2 * (I_C - 3 - ln((I_C + 1) / 4)) + lam_s / 2 * ((J - alpha) ** 2 - (1 - alpha) ** 2)
///
/// Operations:
/// - energy: 25 multiplications, 20 additions, log
/// - stress: 52 multiplications, 31 additions, 1 division
/// - stress_change: 129 multiplications, 92 additions, 1 division
/// - tangent: 154 multiplications, 94 additions, 1 division
template <class T>
struct StableNeoHooke {
  static constexpr std::string_view kName = "stable_neo_hooke";
  static constexpr bool kLinear = false;         ///< one tangent serves every F
  static constexpr bool kFrameInvariant = true;  ///< blind to rotation
  static constexpr bool kIsotropic = true;       ///< blind to the axes of the rest shape
  static constexpr bool kHomogeneous = false;    ///< in proportion to its constants
  static constexpr bool kAddition = false;       ///< to be added to a base law
  T mu_s;                                        ///< 4*young/(3*(2*poisson + 2))
  T lambda_s;  ///< poisson*young/((1 - 2*poisson)*(poisson + 1)) + 5*young/(6*(2*poisson + 2))
  T alpha;     ///< 1 + 3*mu_s/(4*lambda_s)

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
    const T x0 = T(1.0) - alpha;
    const T x1 = J - alpha;
    const T W = T(0.5) * lambda_s * (x1 * x1 - x0 * x0) +
                T(0.5) * mu_s * (I_C - log(T(0.25) * (I_C + T(1.0))) - T(3.0));
    return W;
  }

  /// P = dW/dF [Pa]
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
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
    const T inverse0 = T(1.0) / (T(0.25) * I_C + T(0.25));
    const T p_F = mu_s * (T(1.0) - T(0.25) * inverse0);
    const T p_K = lambda_s * (J - alpha);
    Tensor2<T> P;
    P(0, 0) = F(0, 0) * p_F + K00 * p_K;
    P(0, 1) = F(0, 1) * p_F + K01 * p_K;
    P(0, 2) = F(0, 2) * p_F + K02 * p_K;
    P(1, 0) = F(1, 0) * p_F + K10 * p_K;
    P(1, 1) = F(1, 1) * p_F + K11 * p_K;
    P(1, 2) = F(1, 2) * p_F + K12 * p_K;
    P(2, 0) = F(2, 0) * p_F + K20 * p_K;
    P(2, 1) = F(2, 1) * p_F + K21 * p_K;
    P(2, 2) = F(2, 2) * p_F + K22 * p_K;
    return P;
  }

  /// dP = dP/dF : dF [Pa]
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
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
    const T inverse0 = T(1.0) / (T(0.25) * I_C + T(0.25));
    const T p_F = mu_s * (T(1.0) - T(0.25) * inverse0);
    const T p_K = lambda_s * (J - alpha);
    const T m_F_F = T(0.125) * mu_s * inverse0 * inverse0;
    const T along_F = F(0, 0) * dF(0, 0) + F(0, 1) * dF(0, 1) + F(0, 2) * dF(0, 2) + F(1, 0) * dF(1, 0) +
                      F(1, 1) * dF(1, 1) + F(1, 2) * dF(1, 2) + F(2, 0) * dF(2, 0) + F(2, 1) * dF(2, 1) +
                      F(2, 2) * dF(2, 2);
    const T along_K = K00 * dF(0, 0) + K01 * dF(0, 1) + K02 * dF(0, 2) + K10 * dF(1, 0) + K11 * dF(1, 1) +
                      K12 * dF(1, 2) + K20 * dF(2, 0) + K21 * dF(2, 1) + K22 * dF(2, 2);
    const T dp_F = along_F * m_F_F;
    const T dp_K = along_K * lambda_s;
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
    dP(0, 0) = F(0, 0) * dp_F + K00 * dp_K + dF(0, 0) * p_F + dK00 * p_K;
    dP(0, 1) = F(0, 1) * dp_F + K01 * dp_K + dF(0, 1) * p_F + dK01 * p_K;
    dP(0, 2) = F(0, 2) * dp_F + K02 * dp_K + dF(0, 2) * p_F + dK02 * p_K;
    dP(1, 0) = F(1, 0) * dp_F + K10 * dp_K + dF(1, 0) * p_F + dK10 * p_K;
    dP(1, 1) = F(1, 1) * dp_F + K11 * dp_K + dF(1, 1) * p_F + dK11 * p_K;
    dP(1, 2) = F(1, 2) * dp_F + K12 * dp_K + dF(1, 2) * p_F + dK12 * p_K;
    dP(2, 0) = F(2, 0) * dp_F + K20 * dp_K + dF(2, 0) * p_F + dK20 * p_K;
    dP(2, 1) = F(2, 1) * dp_F + K21 * dp_K + dF(2, 1) * p_F + dK21 * p_K;
    dP(2, 2) = F(2, 2) * dp_F + K22 * dp_K + dF(2, 2) * p_F + dK22 * p_K;
    return dP;
  }

  /// dP/dF, upper triangle [Pa]
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
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
    const T inverse0 = T(1.0) / (T(0.25) * I_C + T(0.25));
    const T p_F = mu_s * (T(1.0) - T(0.25) * inverse0);
    const T p_K = lambda_s * (J - alpha);
    const T m_F_F = T(0.125) * mu_s * inverse0 * inverse0;
    const T r_K_00 = K00 * lambda_s;
    const T r_K_01 = K01 * lambda_s;
    const T r_K_02 = K02 * lambda_s;
    const T r_K_10 = K10 * lambda_s;
    const T r_K_11 = K11 * lambda_s;
    const T r_K_12 = K12 * lambda_s;
    const T r_K_20 = K20 * lambda_s;
    const T r_K_21 = K21 * lambda_s;
    const T r_K_22 = K22 * lambda_s;
    const T r_F_00 = F(0, 0) * m_F_F;
    const T r_F_01 = F(0, 1) * m_F_F;
    const T r_F_02 = F(0, 2) * m_F_F;
    const T r_F_10 = F(1, 0) * m_F_F;
    const T r_F_11 = F(1, 1) * m_F_F;
    const T r_F_12 = F(1, 2) * m_F_F;
    const T r_F_20 = F(2, 0) * m_F_F;
    const T r_F_21 = F(2, 1) * m_F_F;
    const T r_F_22 = F(2, 2) * m_F_F;
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
    A(0, 0, 0, 0) = p_F + F(0, 0) * r_F_00 + K00 * r_K_00;
    A(0, 0, 0, 1) = F(0, 1) * r_F_00 + K01 * r_K_00;
    A(0, 0, 0, 2) = F(0, 2) * r_F_00 + K02 * r_K_00;
    A(0, 0, 1, 0) = F(1, 0) * r_F_00 + K10 * r_K_00;
    A(0, 0, 1, 1) = kF22 + F(1, 1) * r_F_00 + K11 * r_K_00;
    A(0, 0, 1, 2) = F(1, 2) * r_F_00 + K12 * r_K_00 - kF21;
    A(0, 0, 2, 0) = F(2, 0) * r_F_00 + K20 * r_K_00;
    A(0, 0, 2, 1) = F(2, 1) * r_F_00 + K21 * r_K_00 - kF12;
    A(0, 0, 2, 2) = kF11 + F(2, 2) * r_F_00 + K22 * r_K_00;
    A(0, 1, 0, 1) = p_F + F(0, 1) * r_F_01 + K01 * r_K_01;
    A(0, 1, 0, 2) = F(0, 2) * r_F_01 + K02 * r_K_01;
    A(0, 1, 1, 0) = F(1, 0) * r_F_01 + K10 * r_K_01 - kF22;
    A(0, 1, 1, 1) = F(1, 1) * r_F_01 + K11 * r_K_01;
    A(0, 1, 1, 2) = kF20 + F(1, 2) * r_F_01 + K12 * r_K_01;
    A(0, 1, 2, 0) = kF12 + F(2, 0) * r_F_01 + K20 * r_K_01;
    A(0, 1, 2, 1) = F(2, 1) * r_F_01 + K21 * r_K_01;
    A(0, 1, 2, 2) = F(2, 2) * r_F_01 + K22 * r_K_01 - kF10;
    A(0, 2, 0, 2) = p_F + F(0, 2) * r_F_02 + K02 * r_K_02;
    A(0, 2, 1, 0) = kF21 + F(1, 0) * r_F_02 + K10 * r_K_02;
    A(0, 2, 1, 1) = F(1, 1) * r_F_02 + K11 * r_K_02 - kF20;
    A(0, 2, 1, 2) = F(1, 2) * r_F_02 + K12 * r_K_02;
    A(0, 2, 2, 0) = F(2, 0) * r_F_02 + K20 * r_K_02 - kF11;
    A(0, 2, 2, 1) = kF10 + F(2, 1) * r_F_02 + K21 * r_K_02;
    A(0, 2, 2, 2) = F(2, 2) * r_F_02 + K22 * r_K_02;
    A(1, 0, 1, 0) = p_F + F(1, 0) * r_F_10 + K10 * r_K_10;
    A(1, 0, 1, 1) = F(1, 1) * r_F_10 + K11 * r_K_10;
    A(1, 0, 1, 2) = F(1, 2) * r_F_10 + K12 * r_K_10;
    A(1, 0, 2, 0) = F(2, 0) * r_F_10 + K20 * r_K_10;
    A(1, 0, 2, 1) = kF02 + F(2, 1) * r_F_10 + K21 * r_K_10;
    A(1, 0, 2, 2) = F(2, 2) * r_F_10 + K22 * r_K_10 - kF01;
    A(1, 1, 1, 1) = p_F + F(1, 1) * r_F_11 + K11 * r_K_11;
    A(1, 1, 1, 2) = F(1, 2) * r_F_11 + K12 * r_K_11;
    A(1, 1, 2, 0) = F(2, 0) * r_F_11 + K20 * r_K_11 - kF02;
    A(1, 1, 2, 1) = F(2, 1) * r_F_11 + K21 * r_K_11;
    A(1, 1, 2, 2) = kF00 + F(2, 2) * r_F_11 + K22 * r_K_11;
    A(1, 2, 1, 2) = p_F + F(1, 2) * r_F_12 + K12 * r_K_12;
    A(1, 2, 2, 0) = kF01 + F(2, 0) * r_F_12 + K20 * r_K_12;
    A(1, 2, 2, 1) = F(2, 1) * r_F_12 + K21 * r_K_12 - kF00;
    A(1, 2, 2, 2) = F(2, 2) * r_F_12 + K22 * r_K_12;
    A(2, 0, 2, 0) = p_F + F(2, 0) * r_F_20 + K20 * r_K_20;
    A(2, 0, 2, 1) = F(2, 1) * r_F_20 + K21 * r_K_20;
    A(2, 0, 2, 2) = F(2, 2) * r_F_20 + K22 * r_K_20;
    A(2, 1, 2, 1) = p_F + F(2, 1) * r_F_21 + K21 * r_K_21;
    A(2, 1, 2, 2) = F(2, 2) * r_F_21 + K22 * r_K_21;
    A(2, 2, 2, 2) = p_F + F(2, 2) * r_F_22 + K22 * r_K_22;
    return A;
  }
};

}  // namespace tissu
