#pragma once

// Made from python/tissu/codegen/laws/yeoh.py
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <cmath>
#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// Yeoh, nearly incompressible: a cubic in Ibar1 - 3.
///
/// Yeoh, Some forms of the strain energy function for rubber, Rubber Chem. Technol. 66(5), 1993.
/// The law stiffens at large stretch if c3 > 0. If c2 < 0, it may soften before it stiffens.
///
///     W = c1 * (Ibar1 - 3) + c2 * (Ibar1 - 3) ** 2 + c3 * (Ibar1 - 3) ** 3 + kappa / 2 * (J - 1) ** 2
///
/// Operations:
/// - energy: 26 multiplications, 18 additions, 1 division, cbrt
/// - stress: 62 multiplications, 33 additions, 1 division, cbrt
/// - stress_change: 162 multiplications, 103 additions, 1 division, cbrt
/// - tangent: 203 multiplications, 121 additions, 1 division, cbrt
template <class T>
struct Yeoh {
  static constexpr std::string_view kName = "yeoh";
  static constexpr bool kLinear = false;         ///< one tangent serves every F
  static constexpr bool kFrameInvariant = true;  ///< blind to rotation
  static constexpr bool kIsotropic = true;       ///< blind to the axes of the rest shape
  static constexpr bool kHomogeneous = true;     ///< in proportion to its constants
  static constexpr bool kAddition = false;       ///< to be added to a base law
  T c1;
  T c2;
  T c3;
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
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
    const T Ibar1 = I_C * J_23;
    const T x0 = J - T(1.0);
    const T x1 = Ibar1 - T(3.0);
    const T W = x1 * (c1 + x1 * (c2 + c3 * x1)) + T(0.5) * kappa * x0 * x0;
    return W;
  }

  /// P = dW/dF [Pa]
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    using std::cbrt;
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
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
    const T Ibar1 = I_C * J_23;
    const T J_inv = J_23 * root;
    const T x0 = Ibar1 - T(3.0);
    const T x1 = c1 + T(2.0) * c2 * x0 + T(3.0) * c3 * x0 * x0;
    const T p_F = T(2.0) * J_23 * x1;
    const T p_K = kappa * (J - T(1.0)) - T(2.0 / 3.0) * Ibar1 * J_inv * x1;
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
    using std::cbrt;
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
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
    const T Ibar1 = I_C * J_23;
    const T J_inv = J_23 * root;
    const T x0 = Ibar1 - T(3.0);
    const T x3 = T(3.0) * c3;
    const T x6 = Ibar1 * Ibar1;
    const T x1 = c2 * x0;
    const T x2 = x0 * x0;
    const T x5 = c2 + x0 * x3;
    const T x4 = c1 + T(2.0) * x1 + x2 * x3;
    const T p_F = T(2.0) * J_23 * x4;
    const T p_K = kappa * (J - T(1.0)) - T(2.0 / 3.0) * Ibar1 * J_inv * x4;
    const T m_F_F = T(8.0) * x5 * J_23 * J_23;
    const T m_F_K = -T(4.0 / 3.0) * J_23 * J_inv * (x4 + T(2.0) * Ibar1 * x5);
    const T m_K_K =
        kappa + J_inv * J_inv *
                    (T(8.0 / 9.0) * c2 * x6 + T(10.0 / 9.0) * Ibar1 * c1 + T(20.0 / 9.0) * Ibar1 * x1 +
                     T(8.0 / 3.0) * c3 * x0 * x6 + T(10.0 / 3.0) * Ibar1 * c3 * x2);
    const T along_F = F(0, 0) * dF(0, 0) + F(0, 1) * dF(0, 1) + F(0, 2) * dF(0, 2) + F(1, 0) * dF(1, 0) +
                      F(1, 1) * dF(1, 1) + F(1, 2) * dF(1, 2) + F(2, 0) * dF(2, 0) + F(2, 1) * dF(2, 1) +
                      F(2, 2) * dF(2, 2);
    const T along_K = K00 * dF(0, 0) + K01 * dF(0, 1) + K02 * dF(0, 2) + K10 * dF(1, 0) + K11 * dF(1, 1) +
                      K12 * dF(1, 2) + K20 * dF(2, 0) + K21 * dF(2, 1) + K22 * dF(2, 2);
    const T dp_F = along_F * m_F_F + along_K * m_F_K;
    const T dp_K = along_F * m_F_K + along_K * m_K_K;
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
    using std::cbrt;
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
    const T I_C = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1) + F(0, 2) * F(0, 2) + F(1, 0) * F(1, 0) +
                  F(1, 1) * F(1, 1) + F(1, 2) * F(1, 2) + F(2, 0) * F(2, 0) + F(2, 1) * F(2, 1) +
                  F(2, 2) * F(2, 2);
    const T Ibar1 = I_C * J_23;
    const T J_inv = J_23 * root;
    const T x0 = Ibar1 - T(3.0);
    const T x3 = T(3.0) * c3;
    const T x6 = Ibar1 * Ibar1;
    const T x1 = c2 * x0;
    const T x2 = x0 * x0;
    const T x5 = c2 + x0 * x3;
    const T x4 = c1 + T(2.0) * x1 + x2 * x3;
    const T p_F = T(2.0) * J_23 * x4;
    const T p_K = kappa * (J - T(1.0)) - T(2.0 / 3.0) * Ibar1 * J_inv * x4;
    const T m_F_F = T(8.0) * x5 * J_23 * J_23;
    const T m_F_K = -T(4.0 / 3.0) * J_23 * J_inv * (x4 + T(2.0) * Ibar1 * x5);
    const T m_K_K =
        kappa + J_inv * J_inv *
                    (T(8.0 / 9.0) * c2 * x6 + T(10.0 / 9.0) * Ibar1 * c1 + T(20.0 / 9.0) * Ibar1 * x1 +
                     T(8.0 / 3.0) * c3 * x0 * x6 + T(10.0 / 3.0) * Ibar1 * c3 * x2);
    const T r_K_00 = F(0, 0) * m_F_K + K00 * m_K_K;
    const T r_K_01 = F(0, 1) * m_F_K + K01 * m_K_K;
    const T r_K_02 = F(0, 2) * m_F_K + K02 * m_K_K;
    const T r_K_10 = F(1, 0) * m_F_K + K10 * m_K_K;
    const T r_K_11 = F(1, 1) * m_F_K + K11 * m_K_K;
    const T r_K_12 = F(1, 2) * m_F_K + K12 * m_K_K;
    const T r_K_20 = F(2, 0) * m_F_K + K20 * m_K_K;
    const T r_K_21 = F(2, 1) * m_F_K + K21 * m_K_K;
    const T r_K_22 = F(2, 2) * m_F_K + K22 * m_K_K;
    const T r_F_00 = F(0, 0) * m_F_F + K00 * m_F_K;
    const T r_F_01 = F(0, 1) * m_F_F + K01 * m_F_K;
    const T r_F_02 = F(0, 2) * m_F_F + K02 * m_F_K;
    const T r_F_10 = F(1, 0) * m_F_F + K10 * m_F_K;
    const T r_F_11 = F(1, 1) * m_F_F + K11 * m_F_K;
    const T r_F_12 = F(1, 2) * m_F_F + K12 * m_F_K;
    const T r_F_20 = F(2, 0) * m_F_F + K20 * m_F_K;
    const T r_F_21 = F(2, 1) * m_F_F + K21 * m_F_K;
    const T r_F_22 = F(2, 2) * m_F_F + K22 * m_F_K;
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
