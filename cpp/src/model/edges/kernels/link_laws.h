#pragma once

/// What a law says to the squared lengths of a tetrahedron's edges: tensions t_e = 2 dW/d(l_e^2), moduli
/// H_ef = 4 d2W/d(l_e^2)d(l_f^2), energy. The forms are those of tissu/model/mass_link.h.

#include <string_view>

#include "tissu/base/batch.h"
#include "tissu/law/tensor.h"
#include "tissu/model/edges/tetra_edges.h"

namespace tissu::TISSU_KERNELS {

TISSU_INLINE Batch dot(const Batch (&a)[3], const Batch (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The six edges as they are now.
struct LinkEdges {
  Batch d[6][3];    ///< [m]
  Batch square[6];  ///< squared lengths [m2]

  /// Six times the volume, negative where the tetrahedron is turned inside out.
  TISSU_INLINE Batch six_volumes() const {
    return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) +
           d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
           d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  }
};

TISSU_INLINE void differences(const Batch (&x)[4][3], Batch (&d)[6][3]) {
  TISSU_UNROLL
  for (int e = 0; e < 6; ++e) {
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) d[e][i] = x[kTetraEdges[e][1]][i] - x[kTetraEdges[e][0]][i];
  }
}

/// 21 numbers of 4 V MW, then 6 of l0^2.
struct LinkStVK {
  static constexpr std::string_view kName = "stvk";
  static constexpr int kReals = kEdgePairs + 6;
  const double* constants;

  TISSU_INLINE Batch modulus(int e, int f) const { return Batch::load(constants + edge_pair(e, f) * kLanes); }
  TISSU_INLINE void tensions(const LinkEdges& at, Batch (&t)[6]) const {
    Batch change[6];
    TISSU_UNROLL
    for (int e = 0; e < 6; ++e) change[e] = at.square[e] - Batch::load(constants + (kEdgePairs + e) * kLanes);
    TISSU_UNROLL
    for (int e = 0; e < 6; ++e) {
      t[e] = modulus(e, 0) * change[0];
      TISSU_UNROLL
      for (int f = 1; f < 6; ++f) t[e] += modulus(e, f) * change[f];
    }
  }
  TISSU_INLINE void moduli(const LinkEdges& /*at*/, Batch (&H)[kEdgePairs]) const {
    TISSU_UNROLL
    for (int k = 0; k < kEdgePairs; ++k) H[k] = Batch(2.0) * Batch::load(constants + k * kLanes);
  }
  TISSU_INLINE Batch energy(const LinkEdges& at) const {
    Batch t[6];
    tensions(at, t);
    Batch sum(0.0);
    TISSU_UNROLL
    for (int e = 0; e < 6; ++e) {
      sum += t[e] * (at.square[e] - Batch::load(constants + (kEdgePairs + e) * kLanes));
    }
    return Batch(0.25) * sum;
  }
};

/// 6 numbers V mu tr(C_e), then 1 / (6 V), V mu, V lambda.
/// The gradients now, seen through det C, take the part of those at rest: with s_ab = g_a . g_b now, and
/// p = lambda ln J - mu,  t_e = V (mu tr(C_e) - p s_ab),  H = V (lambda s s - p (s s + s s)).
struct LinkNeoHooke {
  static constexpr std::string_view kName = "neo_hooke";
  static constexpr int kReals = 9;
  const double* constants;

  TISSU_INLINE Batch constant(int k) const { return Batch::load(constants + k * kLanes); }
  TISSU_INLINE Batch log_ratio(const LinkEdges& at) const { return log(at.six_volumes() * constant(6)); }
  /// V p
  TISSU_INLINE Batch pressure(const LinkEdges& at) const { return constant(8) * log_ratio(at) - constant(7); }
  /// s_ab from the squared lengths: the inverse of G_ij = (l_0i^2 + l_0j^2 - l_ij^2) / 2, whose rows end in
  /// node 0, the gradients summing to zero.
  TISSU_INLINE static void gradients(const LinkEdges& at, Batch (&s)[4][4]) {
    const Batch(&l)[6] = at.square;
    const Batch G12 = Batch(0.5) * (l[0] + l[1] - l[3]);
    const Batch G23 = Batch(0.5) * (l[1] + l[2] - l[4]);
    const Batch G31 = Batch(0.5) * (l[2] + l[0] - l[5]);
    const Batch root = at.six_volumes();
    const Batch inverse = Batch(1.0) / (root * root);
    s[1][1] = inverse * (l[1] * l[2] - G23 * G23);
    s[2][2] = inverse * (l[2] * l[0] - G31 * G31);
    s[3][3] = inverse * (l[0] * l[1] - G12 * G12);
    s[1][2] = s[2][1] = inverse * (G23 * G31 - G12 * l[2]);
    s[2][3] = s[3][2] = inverse * (G31 * G12 - G23 * l[0]);
    s[3][1] = s[1][3] = inverse * (G12 * G23 - G31 * l[1]);
    TISSU_UNROLL
    for (int i = 1; i < 4; ++i) s[0][i] = s[i][0] = -(s[i][1] + s[i][2] + s[i][3]);
    s[0][0] = -(s[0][1] + s[0][2] + s[0][3]);
  }

  TISSU_INLINE void tensions(const LinkEdges& at, Batch (&t)[6]) const {
    Batch s[4][4];
    gradients(at, s);
    const Batch p = pressure(at);
    TISSU_UNROLL
    for (int e = 0; e < 6; ++e) t[e] = constant(e) - p * s[kTetraEdges[e][0]][kTetraEdges[e][1]];
  }
  TISSU_INLINE void moduli(const LinkEdges& at, Batch (&H)[kEdgePairs]) const {
    Batch s[4][4];
    gradients(at, s);
    edge_moduli(s, constant(8), -pressure(at), H);
  }
  TISSU_INLINE Batch energy(const LinkEdges& at) const {
    const Batch ln_J = log_ratio(at);
    Batch first = Batch(-3.0) * constant(7);  // V mu (I_C - 3)
    TISSU_UNROLL
    for (int e = 0; e < 6; ++e) first += constant(e) * at.square[e];
    return Batch(0.5) * first + ln_J * (Batch(0.5) * constant(8) * ln_J - constant(7));
  }
};

}  // namespace tissu::TISSU_KERNELS
