#pragma once

/// Six links of a tetrahedron for every law and instruction set: lengths from the nodes, tensions from the
/// lengths, forces along the edges.
///   t_e = 2 dW/d(l_e^2),  H_ef = 4 d2W/d(l_e^2)d(l_f^2),  dt_e = sum_f H_ef (d_f . dd_f)
///   f_p = -sum_e s_ep t_e d_e,   df_p/dx_q = -sum_e s_ep s_eq t_e I - sum_ef s_ep s_fq H_ef d_e (x) d_f
/// with d_e the vector along edge e, s_ep = -1 at its first node, 1 at its second and 0 elsewhere.

#include "packed.h"
#include "scatter_pairs.h"
#include "tissu/force/mass_link_kernels.h"
#include "tissu/force/tetra_edges.h"

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

template <class Law>
struct MassLink {
  /// One batch of a group.
  struct Lanes {
    const std::uint16_t* places;
    const std::int32_t* slots;
    Law law;

    TISSU_INLINE Lanes(const MassLinkView& view, std::int32_t group, int lane)
        : places(view.places + static_cast<std::ptrdiff_t>(group) * 4 * kLanes + lane),
          slots(view.slots + static_cast<std::ptrdiff_t>(group) * 16 * kLanes + lane),
          law{view.constants + static_cast<std::ptrdiff_t>(group) * Law::kReals * kLanes + lane} {}
    TISSU_INLINE void differences_of(const PackedNodes& nodes, Batch (&d)[6][3]) const {
      Batch x[4][3];
      TISSU_UNROLL
      for (int a = 0; a < 4; ++a) gather_packed(nodes.values, places + a * kLanes, x[a]);
      differences(x, d);
    }
    TISSU_INLINE LinkEdges edges(const PackedNodes& nodes) const {
      LinkEdges at;
      differences_of(nodes, at.d);
      TISSU_UNROLL
      for (int e = 0; e < 6; ++e) at.square[e] = dot(at.d[e], at.d[e]);
      return at;
    }
    /// Each edge pulls its two nodes together: +y_e at its first, -y_e at its second.
    TISSU_INLINE void pull(const Batch (&y)[6][3], PackedNodes& sums) const {
      Batch f[4][3];
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        f[0][i] = y[0][i] + y[1][i] + y[2][i];
        f[1][i] = y[3][i] - y[0][i] - y[5][i];
        f[2][i] = y[4][i] - y[1][i] - y[3][i];
        f[3][i] = y[5][i] - y[2][i] - y[4][i];
      }
      TISSU_UNROLL
      for (int a = 0; a < 4; ++a) scatter_packed(sums.values, places + a * kLanes, f[a]);
    }
  };

  /// f(lanes, group, lane) for every batch of a chunk.
  template <class Function>
  TISSU_INLINE static void for_batches(const MassLinkView& view, const Chunk& chunk, Function&& f) {
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      for (int lane = 0; lane < kLanes; lane += kWidth) f(Lanes(view, group, lane), group, lane);
    }
  }

  static void force(const MassLinkView& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes positions;
    PackedNodes sums;
    positions.load(chunk, x);
    sums.clear(chunk);
    for_batches(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          const LinkEdges at = lanes.edges(positions);
          Batch t[6];
          Batch y[6][3];
          lanes.law.tensions(at, t);
          TISSU_UNROLL
          for (int e = 0; e < 6; ++e) {
            TISSU_UNROLL
            for (int i = 0; i < 3; ++i) y[e][i] = t[e] * at.d[e][i];
          }
          lanes.pull(y, sums);
        });
    sums.add_to(chunk, f);
  }

  static void product(const MassLinkView& view, const Chunk& chunk, const double* x, double scale,
                      const double* p, double* out) {
    PackedNodes positions;
    PackedNodes changes;
    PackedNodes sums;
    positions.load(chunk, x);
    changes.load(chunk, p);
    sums.clear(chunk);
    for_batches(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          const LinkEdges at = lanes.edges(positions);
          Batch change[6][3];
          Batch t[6];
          Batch H[kEdgePairs];
          Batch along[6];
          lanes.differences_of(changes, change);
          lanes.law.tensions(at, t);
          lanes.law.moduli(at, H);
          TISSU_UNROLL
          for (int e = 0; e < 6; ++e) along[e] = Batch(scale) * dot(at.d[e], change[e]);
          Batch y[6][3];
          TISSU_UNROLL
          for (int e = 0; e < 6; ++e) {
            Batch dt = H[edge_pair(e, 0)] * along[0];
            TISSU_UNROLL
            for (int f = 1; f < 6; ++f) dt += H[edge_pair(e, f)] * along[f];
            const Batch scaled = Batch(scale) * t[e];
            TISSU_UNROLL
            for (int i = 0; i < 3; ++i) y[e][i] = dt * at.d[e][i] + scaled * change[e][i];
          }
          lanes.pull(y, sums);
        });
    sums.add_to(chunk, out);
  }

  /// The edges at each node, and whether they end (1) or begin (-1) there.
  static constexpr int kAt[4][3] = {{0, 1, 2}, {0, 3, 5}, {1, 3, 4}, {2, 4, 5}};
  static constexpr double kSign[4][3] = {{-1, -1, -1}, {1, -1, 1}, {1, 1, -1}, {1, 1, -1}};

  /// K_pq of the nodes 1 <= p <= q, times -scale being in t and H.
  TISSU_INLINE static void node_pairs(const LinkEdges& at, const Batch (&t)[6], const Batch (&H)[kEdgePairs],
                                      Batch (&K)[6][9]) {
    int pair = 0;
    TISSU_UNROLL
    for (int q = 1; q < 4; ++q) {
      Batch pulled[6][3];  // dt_e/dx_q
      TISSU_UNROLL
      for (int e = 0; e < 6; ++e) {
        TISSU_UNROLL
        for (int i = 0; i < 3; ++i) {
          Batch sum(0.0);
          TISSU_UNROLL
          for (int k = 0; k < 3; ++k) {
            const Batch part = H[edge_pair(e, kAt[q][k])] * at.d[kAt[q][k]][i];
            sum = k == 0 ? (kSign[q][k] > 0 ? part : -part) : (kSign[q][k] > 0 ? sum + part : sum - part);
          }
          pulled[e][i] = sum;
        }
      }
      TISSU_UNROLL
      for (int p = 1; p <= q; ++p, ++pair) {
        Batch own(0.0);
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          const int e = kAt[p][k];
          if (p == q) own += t[e];
          if (p != q && (kTetraEdges[e][0] == q || kTetraEdges[e][1] == q)) own -= t[e];
        }
        TISSU_UNROLL
        for (int c = 0; c < 9; ++c) {
          Batch sum = c % 3 == c / 3 ? own : Batch(0.0);
          TISSU_UNROLL
          for (int k = 0; k < 3; ++k) {
            const Batch part = at.d[kAt[p][k]][c % 3] * pulled[kAt[p][k]][c / 3];
            sum = kSign[p][k] > 0 ? sum + part : sum - part;
          }
          K[pair][c] = sum;
        }
      }
    }
  }

  static void stiffness(const MassLinkView& view, const Chunk& chunk, const double* x, double scale,
                        double* blocks) {
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          const LinkEdges at = lanes.edges(positions);
          Batch t[6];
          Batch H[kEdgePairs];
          lanes.law.tensions(at, t);
          lanes.law.moduli(at, H);
          for (Batch& value : t) value = Batch(-scale) * value;
          for (Batch& value : H) value = Batch(-scale) * value;
          Batch K[6][9];
          node_pairs(at, t, H, K);
          int pair = 0;
          for (int q = 1; q < 4; ++q) {
            for (int p = 1; p <= q; ++p, ++pair) scatter_pair<4>(lanes.slots, p, q, K[pair], blocks);
          }
          scatter_first_node<4>(lanes.slots, K, blocks);
        });
  }

  static void energy(const MassLinkView& view, const Chunk& chunk, const double* x, double* energies) {
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches(
        view, chunk, [&](const Lanes& lanes, std::int32_t group, int lane) __attribute__((always_inline)) {
          double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes + lane;
          (Batch::load(to) + lanes.law.energy(lanes.edges(positions))).store(to);
        });
  }

  /// The virial of the links: sigma = 1/v sum_e t_e d_e (x) d_e.
  static void stress(const MassLinkView& view, const Chunk& chunk, const double* x, double* stresses,
                     double* volumes) {
    constexpr int row[6] = {0, 1, 2, 1, 0, 0};
    constexpr int column[6] = {0, 1, 2, 2, 2, 1};
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches(
        view, chunk, [&](const Lanes& lanes, std::int32_t group, int lane) __attribute__((always_inline)) {
          const LinkEdges at = lanes.edges(positions);
          Batch t[6];
          lanes.law.tensions(at, t);
          const Batch volume = at.six_volumes() / Batch(6.0);
          double* to = stresses + static_cast<std::ptrdiff_t>(group) * 6 * kLanes + lane;
          TISSU_UNROLL
          for (int s = 0; s < 6; ++s) {
            Batch sum(0.0);
            TISSU_UNROLL
            for (int e = 0; e < 6; ++e) sum += t[e] * at.d[e][row[s]] * at.d[e][column[s]];
            (sum / volume).store(to + s * kLanes);
          }
          volume.store(volumes + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
        });
  }

  static constexpr MassLinkKernels table() {
    return {Law::kName, Law::kReals, &force, &product, &stiffness, &energy, &stress};
  }
};

}  // namespace tissu::TISSU_KERNELS
