#pragma once

/// Six links of a tetrahedron for every law and instruction set: lengths from the nodes, tensions from the
/// lengths, forces along the edges.
///   t_e = 2 dW/d(l_e^2),  H_ef = 4 d2W/d(l_e^2)d(l_f^2),  dt_e = sum_f H_ef (d_f . dd_f)
///   f_p = -sum_e s_ep t_e d_e,   df_p/dx_q = -sum_e s_ep s_eq t_e I - sum_ef s_ep s_fq H_ef d_e (x) d_f
/// with d_e the vector along edge e, s_ep = -1 at its first node, 1 at its second and 0 elsewhere.

#include "cell/kernels/for_batches.h"
#include "cell/kernels/packed.h"
#include "cell/kernels/scatter_pairs.h"
#include "cell/kernels/semidefinite.h"
#include "link_laws.h"
#include "tissu/model/edges/mass_link_kernels.h"

namespace tissu::TISSU_KERNELS {

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

  static void force(const MassLinkView& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes positions;
    PackedNodes sums;
    positions.load(chunk, x);
    sums.clear(chunk);
    for_batches<Lanes>(
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
    for_batches<Lanes>(
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

  /// dt_e/dx_q of the six edges.
  TISSU_INLINE static void tension_slopes(const LinkEdges& at, const Batch (&H)[kEdgePairs], int q,
                                          Batch (&slopes)[6][3]) {
    TISSU_UNROLL
    for (int e = 0; e < 6; ++e) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        Batch sum(0.0);
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          const Batch part = H[edge_pair(e, kAt[q][k])] * at.d[kAt[q][k]][i];
          sum = kSign[q][k] > 0 ? sum + part : sum - part;
        }
        slopes[e][i] = sum;
      }
    }
  }

  /// What the tensions themselves add to the diagonal of K_pq.
  TISSU_INLINE static Batch own_tension(const Batch (&t)[6], int p, int q) {
    Batch own(0.0);
    TISSU_UNROLL
    for (int k = 0; k < 3; ++k) {
      const int e = kAt[p][k];
      if (p == q) own += t[e];
      if (p != q && (kTetraEdges[e][0] == q || kTetraEdges[e][1] == q)) own -= t[e];
    }
    return own;
  }

  /// K_pq of the nodes 1 <= p <= q; t and H have the factor -scale.
  TISSU_INLINE static void node_pairs(const LinkEdges& at, const Batch (&t)[6], const Batch (&H)[kEdgePairs],
                                      Batch (&K)[6][9]) {
    int pair = 0;
    TISSU_UNROLL
    for (int q = 1; q < 4; ++q) {
      Batch slopes[6][3];
      tension_slopes(at, H, q, slopes);
      TISSU_UNROLL
      for (int p = 1; p <= q; ++p, ++pair) {
        const Batch own = own_tension(t, p, q);
        TISSU_UNROLL
        for (int c = 0; c < 9; ++c) {
          Batch sum = c % 3 == c / 3 ? own : Batch(0.0);
          TISSU_UNROLL
          for (int k = 0; k < 3; ++k) {
            const Batch part = at.d[kAt[p][k]][c % 3] * slopes[kAt[p][k]][c / 3];
            sum = kSign[p][k] > 0 ? sum + part : sum - part;
          }
          K[pair][c] = sum;
        }
      }
    }
  }

  template <bool kDefinite>
  static void stiffness(const MassLinkView& view, const Chunk& chunk, const double* x, double scale,
                        double* blocks) {
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          const LinkEdges at = lanes.edges(positions);
          Batch t[6];
          Batch H[kEdgePairs];
          lanes.law.tensions(at, t);
          lanes.law.moduli(at, H);
          Batch K[6][9];
          if constexpr (kDefinite) {
            node_pairs(at, t, H, K);
            make_tetra_semidefinite(K);
            for (auto& block : K) {
              for (Batch& value : block) value = Batch(-scale) * value;
            }
          } else {
            for (Batch& value : t) value = Batch(-scale) * value;
            for (Batch& value : H) value = Batch(-scale) * value;
            node_pairs(at, t, H, K);
          }
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
    for_batches<Lanes>(
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
    for_batches<Lanes>(
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
    return {Law::kName, Law::kReals, &force, &product, &stiffness<false>, &energy, &stress, &stiffness<true>};
  }
};

}  // namespace tissu::TISSU_KERNELS
