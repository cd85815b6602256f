#pragma once

// Made from python/tissu/codegen/laws/fibre.py
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include <cmath>
#include <string_view>

#include "tissu/law/functions.h"
#include "tissu/law/tensor.h"

namespace tissu {

/// One family of fibres, to be added to any base law: stiff when stretched, nothing when slack.
///
/// Holzapfel, Gasser, Ogden, J. Elasticity 61, 2000, one family, without dispersion. a is the direction
/// at rest, a unit vector. The tangent jumps where the fibre goes slack, and grows like exp(k2 x^2).
///
///     W = k1 / (2 * k2) * (exp(k2 * positive(Ibar4 - 1) ** 2) - 1)
///
/// Operations:
/// - energy: 28 multiplications, 15 additions, 2 divisions, cbrt, exp, positive
/// - stress: 66 multiplications, 29 additions, 1 division, cbrt, exp, positive
/// - stress_change: 159 multiplications, 91 additions, 1 division, cbrt, exp, positive, step
/// - tangent: 218 multiplications, 124 additions, 1 division, cbrt, exp, positive, step
template <class T>
struct Fibre {
  static constexpr std::string_view kName = "fibre";
  static constexpr bool kLinear = false;         ///< one tangent serves every F
  static constexpr bool kFrameInvariant = true;  ///< blind to rotation
  static constexpr bool kIsotropic = false;      ///< blind to the axes of the rest shape
  static constexpr bool kHomogeneous = false;    ///< in proportion to its constants
  static constexpr bool kAddition = true;        ///< to be added to a base law
  T k1;
  T k2;
  T a0;  ///< direction_x/sqrt(direction_x^2 + direction_y^2 + direction_z^2)
  T a1;  ///< direction_y/sqrt(direction_x^2 + direction_y^2 + direction_z^2)
  T a2;  ///< direction_z/sqrt(direction_x^2 + direction_y^2 + direction_z^2)

  /// W [J/m3]
  [[nodiscard]] T energy(const Tensor2<T>& F) const {
    using std::cbrt;
    using std::exp;
    const T K00 = F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1);
    const T K01 = F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2);
    const T K02 = F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0);
    const T J = F(0, 0) * K00 + F(0, 1) * K01 + F(0, 2) * K02;
    const T root = T(1.0) / cbrt(J);
    const T J_23 = root * root;
    const T f0 = F(0, 0) * a0 + F(0, 1) * a1 + F(0, 2) * a2;
    const T f1 = F(1, 0) * a0 + F(1, 1) * a1 + F(1, 2) * a2;
    const T f2 = F(2, 0) * a0 + F(2, 1) * a1 + F(2, 2) * a2;
    const T I4 = f0 * f0 + f1 * f1 + f2 * f2;
    const T Ibar4 = I4 * J_23;
    const T x0 = positive(Ibar4 - T(1.0));
    const T inverse0 = T(1.0) / k2;
    const T W = T(0.5) * inverse0 * k1 * (exp(k2 * x0 * x0) - T(1.0));
    return W;
  }

  /// P = dW/dF [Pa]
  [[nodiscard]] Tensor2<T> stress(const Tensor2<T>& F) const {
    using std::cbrt;
    using std::exp;
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
    const T f0 = F(0, 0) * a0 + F(0, 1) * a1 + F(0, 2) * a2;
    const T f1 = F(1, 0) * a0 + F(1, 1) * a1 + F(1, 2) * a2;
    const T f2 = F(2, 0) * a0 + F(2, 1) * a1 + F(2, 2) * a2;
    const T I4 = f0 * f0 + f1 * f1 + f2 * f2;
    const T Ibar4 = I4 * J_23;
    const T J_inv = J_23 * root;
    const T x0 = positive(Ibar4 - T(1.0));
    const T x1 = k1 * x0 * exp(k2 * x0 * x0);
    const T p_K = -T(2.0 / 3.0) * Ibar4 * J_inv * x1;
    const T p_N = T(2.0) * J_23 * x1;
    const T g0 = f0 * p_N;
    const T g1 = f1 * p_N;
    const T g2 = f2 * p_N;
    Tensor2<T> P;
    P(0, 0) = K00 * p_K + a0 * g0;
    P(0, 1) = K01 * p_K + a1 * g0;
    P(0, 2) = K02 * p_K + a2 * g0;
    P(1, 0) = K10 * p_K + a0 * g1;
    P(1, 1) = K11 * p_K + a1 * g1;
    P(1, 2) = K12 * p_K + a2 * g1;
    P(2, 0) = K20 * p_K + a0 * g2;
    P(2, 1) = K21 * p_K + a1 * g2;
    P(2, 2) = K22 * p_K + a2 * g2;
    return P;
  }

  /// dP = dP/dF : dF [Pa]
  [[nodiscard]] Tensor2<T> stress_change(const Tensor2<T>& F, const Tensor2<T>& dF) const {
    using std::cbrt;
    using std::exp;
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
    const T f0 = F(0, 0) * a0 + F(0, 1) * a1 + F(0, 2) * a2;
    const T f1 = F(1, 0) * a0 + F(1, 1) * a1 + F(1, 2) * a2;
    const T f2 = F(2, 0) * a0 + F(2, 1) * a1 + F(2, 2) * a2;
    const T I4 = f0 * f0 + f1 * f1 + f2 * f2;
    const T Ibar4 = I4 * J_23;
    const T J_inv = J_23 * root;
    const T x0 = Ibar4 - T(1.0);
    const T x1 = positive(x0);
    const T x5 = step(x0);
    const T x2 = k2 * x1 * x1;
    const T x6 = Ibar4 * x5;
    const T x3 = k1 * exp(x2);
    const T x7 = T(2.0) * x2;
    const T x4 = x1 * x3;
    const T p_K = -T(2.0 / 3.0) * Ibar4 * J_inv * x4;
    const T p_N = T(2.0) * J_23 * x4;
    const T m_K_K =
        T(2.0 / 9.0) * Ibar4 * x3 * J_inv * J_inv * (T(2.0) * x6 + T(5.0) * x1 + T(4.0) * Ibar4 * x2);
    const T m_K_N = -T(4.0 / 3.0) * J_23 * J_inv * x3 * (x1 + x6 + Ibar4 * x7);
    const T m_N_N = T(4.0) * x3 * J_23 * J_23 * (x5 + x7);
    const T along_K = K00 * dF(0, 0) + K01 * dF(0, 1) + K02 * dF(0, 2) + K10 * dF(1, 0) + K11 * dF(1, 1) +
                      K12 * dF(1, 2) + K20 * dF(2, 0) + K21 * dF(2, 1) + K22 * dF(2, 2);
    const T df0 = a0 * dF(0, 0) + a1 * dF(0, 1) + a2 * dF(0, 2);
    const T df1 = a0 * dF(1, 0) + a1 * dF(1, 1) + a2 * dF(1, 2);
    const T df2 = a0 * dF(2, 0) + a1 * dF(2, 1) + a2 * dF(2, 2);
    const T along_N = df0 * f0 + df1 * f1 + df2 * f2;
    const T dp_K = along_K * m_K_K + along_N * m_K_N;
    const T dp_N = along_K * m_K_N + along_N * m_N_N;
    const T dg0 = df0 * p_N + dp_N * f0;
    const T dg1 = df1 * p_N + dp_N * f1;
    const T dg2 = df2 * p_N + dp_N * f2;
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
    dP(0, 0) = K00 * dp_K + a0 * dg0 + dK00 * p_K;
    dP(0, 1) = K01 * dp_K + a1 * dg0 + dK01 * p_K;
    dP(0, 2) = K02 * dp_K + a2 * dg0 + dK02 * p_K;
    dP(1, 0) = K10 * dp_K + a0 * dg1 + dK10 * p_K;
    dP(1, 1) = K11 * dp_K + a1 * dg1 + dK11 * p_K;
    dP(1, 2) = K12 * dp_K + a2 * dg1 + dK12 * p_K;
    dP(2, 0) = K20 * dp_K + a0 * dg2 + dK20 * p_K;
    dP(2, 1) = K21 * dp_K + a1 * dg2 + dK21 * p_K;
    dP(2, 2) = K22 * dp_K + a2 * dg2 + dK22 * p_K;
    return dP;
  }

  /// dP/dF, upper triangle [Pa]
  [[nodiscard]] Tangent<T> tangent(const Tensor2<T>& F) const {
    using std::cbrt;
    using std::exp;
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
    const T f0 = F(0, 0) * a0 + F(0, 1) * a1 + F(0, 2) * a2;
    const T f1 = F(1, 0) * a0 + F(1, 1) * a1 + F(1, 2) * a2;
    const T f2 = F(2, 0) * a0 + F(2, 1) * a1 + F(2, 2) * a2;
    const T I4 = f0 * f0 + f1 * f1 + f2 * f2;
    const T Ibar4 = I4 * J_23;
    const T J_inv = J_23 * root;
    const T x0 = Ibar4 - T(1.0);
    const T x1 = positive(x0);
    const T x5 = step(x0);
    const T x2 = k2 * x1 * x1;
    const T x6 = Ibar4 * x5;
    const T x3 = k1 * exp(x2);
    const T x7 = T(2.0) * x2;
    const T x4 = x1 * x3;
    const T p_K = -T(2.0 / 3.0) * Ibar4 * J_inv * x4;
    const T p_N = T(2.0) * J_23 * x4;
    const T m_K_K =
        T(2.0 / 9.0) * Ibar4 * x3 * J_inv * J_inv * (T(2.0) * x6 + T(5.0) * x1 + T(4.0) * Ibar4 * x2);
    const T m_K_N = -T(4.0 / 3.0) * J_23 * J_inv * x3 * (x1 + x6 + Ibar4 * x7);
    const T m_N_N = T(4.0) * x3 * J_23 * J_23 * (x5 + x7);
    const T N00 = a0 * f0;
    const T N01 = a1 * f0;
    const T N02 = a2 * f0;
    const T N10 = a0 * f1;
    const T N11 = a1 * f1;
    const T N12 = a2 * f1;
    const T N20 = a0 * f2;
    const T N21 = a1 * f2;
    const T N22 = a2 * f2;
    const T r_N_00 = K00 * m_K_N + N00 * m_N_N;
    const T r_N_01 = K01 * m_K_N + N01 * m_N_N;
    const T r_N_02 = K02 * m_K_N + N02 * m_N_N;
    const T r_N_10 = K10 * m_K_N + N10 * m_N_N;
    const T r_N_11 = K11 * m_K_N + N11 * m_N_N;
    const T r_N_12 = K12 * m_K_N + N12 * m_N_N;
    const T r_N_20 = K20 * m_K_N + N20 * m_N_N;
    const T r_N_21 = K21 * m_K_N + N21 * m_N_N;
    const T r_N_22 = K22 * m_K_N + N22 * m_N_N;
    const T r_K_00 = K00 * m_K_K + N00 * m_K_N;
    const T r_K_01 = K01 * m_K_K + N01 * m_K_N;
    const T r_K_02 = K02 * m_K_K + N02 * m_K_N;
    const T r_K_10 = K10 * m_K_K + N10 * m_K_N;
    const T r_K_11 = K11 * m_K_K + N11 * m_K_N;
    const T r_K_12 = K12 * m_K_K + N12 * m_K_N;
    const T r_K_20 = K20 * m_K_K + N20 * m_K_N;
    const T r_K_21 = K21 * m_K_K + N21 * m_K_N;
    const T r_K_22 = K22 * m_K_K + N22 * m_K_N;
    const T pa0 = a0 * p_N;
    const T pa1 = a1 * p_N;
    const T pa2 = a2 * p_N;
    const T T00 = a0 * pa0;
    const T T01 = a1 * pa0;
    const T T02 = a2 * pa0;
    const T T11 = a1 * pa1;
    const T T12 = a2 * pa1;
    const T T22 = a2 * pa2;
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
    A(0, 0, 0, 0) = T00 + K00 * r_K_00 + N00 * r_N_00;
    A(0, 0, 0, 1) = T01 + K01 * r_K_00 + N01 * r_N_00;
    A(0, 0, 0, 2) = T02 + K02 * r_K_00 + N02 * r_N_00;
    A(0, 0, 1, 0) = K10 * r_K_00 + N10 * r_N_00;
    A(0, 0, 1, 1) = kF22 + K11 * r_K_00 + N11 * r_N_00;
    A(0, 0, 1, 2) = K12 * r_K_00 + N12 * r_N_00 - kF21;
    A(0, 0, 2, 0) = K20 * r_K_00 + N20 * r_N_00;
    A(0, 0, 2, 1) = K21 * r_K_00 + N21 * r_N_00 - kF12;
    A(0, 0, 2, 2) = kF11 + K22 * r_K_00 + N22 * r_N_00;
    A(0, 1, 0, 1) = T11 + K01 * r_K_01 + N01 * r_N_01;
    A(0, 1, 0, 2) = T12 + K02 * r_K_01 + N02 * r_N_01;
    A(0, 1, 1, 0) = K10 * r_K_01 + N10 * r_N_01 - kF22;
    A(0, 1, 1, 1) = K11 * r_K_01 + N11 * r_N_01;
    A(0, 1, 1, 2) = kF20 + K12 * r_K_01 + N12 * r_N_01;
    A(0, 1, 2, 0) = kF12 + K20 * r_K_01 + N20 * r_N_01;
    A(0, 1, 2, 1) = K21 * r_K_01 + N21 * r_N_01;
    A(0, 1, 2, 2) = K22 * r_K_01 + N22 * r_N_01 - kF10;
    A(0, 2, 0, 2) = T22 + K02 * r_K_02 + N02 * r_N_02;
    A(0, 2, 1, 0) = kF21 + K10 * r_K_02 + N10 * r_N_02;
    A(0, 2, 1, 1) = K11 * r_K_02 + N11 * r_N_02 - kF20;
    A(0, 2, 1, 2) = K12 * r_K_02 + N12 * r_N_02;
    A(0, 2, 2, 0) = K20 * r_K_02 + N20 * r_N_02 - kF11;
    A(0, 2, 2, 1) = kF10 + K21 * r_K_02 + N21 * r_N_02;
    A(0, 2, 2, 2) = K22 * r_K_02 + N22 * r_N_02;
    A(1, 0, 1, 0) = T00 + K10 * r_K_10 + N10 * r_N_10;
    A(1, 0, 1, 1) = T01 + K11 * r_K_10 + N11 * r_N_10;
    A(1, 0, 1, 2) = T02 + K12 * r_K_10 + N12 * r_N_10;
    A(1, 0, 2, 0) = K20 * r_K_10 + N20 * r_N_10;
    A(1, 0, 2, 1) = kF02 + K21 * r_K_10 + N21 * r_N_10;
    A(1, 0, 2, 2) = K22 * r_K_10 + N22 * r_N_10 - kF01;
    A(1, 1, 1, 1) = T11 + K11 * r_K_11 + N11 * r_N_11;
    A(1, 1, 1, 2) = T12 + K12 * r_K_11 + N12 * r_N_11;
    A(1, 1, 2, 0) = K20 * r_K_11 + N20 * r_N_11 - kF02;
    A(1, 1, 2, 1) = K21 * r_K_11 + N21 * r_N_11;
    A(1, 1, 2, 2) = kF00 + K22 * r_K_11 + N22 * r_N_11;
    A(1, 2, 1, 2) = T22 + K12 * r_K_12 + N12 * r_N_12;
    A(1, 2, 2, 0) = kF01 + K20 * r_K_12 + N20 * r_N_12;
    A(1, 2, 2, 1) = K21 * r_K_12 + N21 * r_N_12 - kF00;
    A(1, 2, 2, 2) = K22 * r_K_12 + N22 * r_N_12;
    A(2, 0, 2, 0) = T00 + K20 * r_K_20 + N20 * r_N_20;
    A(2, 0, 2, 1) = T01 + K21 * r_K_20 + N21 * r_N_20;
    A(2, 0, 2, 2) = T02 + K22 * r_K_20 + N22 * r_N_20;
    A(2, 1, 2, 1) = T11 + K21 * r_K_21 + N21 * r_N_21;
    A(2, 1, 2, 2) = T12 + K22 * r_K_21 + N22 * r_N_21;
    A(2, 2, 2, 2) = T22 + K22 * r_K_22 + N22 * r_N_22;
    return A;
  }
};

}  // namespace tissu
