#pragma once

/// The loops of the mass-tensor model: displacements from positions, terms of tensor_terms.h, f = -dW/du.

#include "cell/kernels/for_batches.h"
#include "cell/kernels/packed.h"
#include "cell/kernels/scatter_pairs.h"
#include "tensor_terms.h"
#include "tissu/model/edges/mass_tensor_kernels.h"

namespace tissu::TISSU_KERNELS {

template <class Pattern>
struct MassTensor : TensorTerms<Pattern> {
  using Terms = TensorTerms<Pattern>;
  using Terms::kNodes;
  using Terms::kPairs;
  using Terms::kReals;
  using Terms::pair;
  using typename Terms::Lanes;
  using typename Terms::Pairs;
  using typename Terms::Vectors;

  /// u = x - X, less that of one node of the body: the energy does not see a translation, its terms do.
  static void load_displacements(const MassTensorView& view, const Chunk& chunk, const double* x,
                                 PackedNodes& u) {
    double shift[3];
    for (int k = 0; k < 3; ++k) shift[k] = at(x, view.origin, 3)[k] - at(view.rest, view.origin, 3)[k];
    u.load(chunk, x);
    for (std::int32_t i = 0; i < chunk.node_count; ++i) {
      const double* X = at(view.rest, chunk.nodes[i], 3);
      double* to = u.values + 4 * static_cast<std::ptrdiff_t>(i);
      for (int k = 0; k < 3; ++k) to[k] = (to[k] - X[k]) - shift[k];
    }
  }

  static void force(const MassTensorView& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes displacements;
    PackedNodes sums;
    load_displacements(view, chunk, x, displacements);
    sums.clear(chunk);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          Vectors u;
          Vectors r;
          Pairs q;
          Pairs w;
          lanes.gather(displacements, u);
          Terms::clear(r);
          Terms::products(u, q);
          Terms::weights(lanes, u, q, w);
          Terms::add_constant_part(lanes, u, q, r);
          Terms::add_pairs(w, u, r);
          TISSU_UNROLL
          for (int a = 0; a < kNodes; ++a) {
            TISSU_UNROLL
            for (int i = 0; i < 3; ++i) r[a][i] = -r[a][i];
          }
          lanes.scatter(r, sums);
        });
    sums.add_to(chunk, f);
  }

  static void product(const MassTensorView& view, const Chunk& chunk, const double* x, double scale,
                      const double* p, double* out) {
    PackedNodes displacements;
    PackedNodes changes;
    PackedNodes sums;
    load_displacements(view, chunk, x, displacements);
    changes.load(chunk, p);
    sums.clear(chunk);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          Vectors u;
          Vectors du;
          Vectors r;
          Pairs q;
          Pairs dq;
          Pairs w;
          Pairs dw;
          lanes.gather(displacements, u);
          lanes.gather(changes, du);
          Terms::clear(r);
          Terms::products(u, q);
          TISSU_UNROLL
          for (int m = 0; m < kPairs; ++m) {
            dq[m] = Terms::dot(du[pair[m][0]], u[pair[m][1]]) + Terms::dot(u[pair[m][0]], du[pair[m][1]]);
          }
          Terms::weights(lanes, u, q, w);
          Terms::weights(lanes, du, dq, dw);
          Terms::add_constant_part(lanes, du, dq, r);
          Terms::add_pairs(w, du, r);
          Terms::add_pairs(dw, u, r);
          TISSU_UNROLL
          for (int a = 0; a < kNodes; ++a) {
            TISSU_UNROLL
            for (int i = 0; i < 3; ++i) r[a][i] = Batch(-scale) * r[a][i];
          }
          lanes.scatter(r, sums);
        });
    sums.add_to(chunk, out);
  }

  static void stiffness(const MassTensorView& view, const Chunk& chunk, const double* x, double scale,
                        double* blocks) {
    PackedNodes displacements;
    load_displacements(view, chunk, x, displacements);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          Vectors u;
          Pairs q;
          Pairs w;
          lanes.gather(displacements, u);
          Terms::products(u, q);
          Terms::weights(lanes, u, q, w);
          TISSU_UNROLL
          for (int s = 0; s < kNodes; ++s) {
            Batch g[Terms::at_least_one(kPairs)][3];
            Terms::weight_slopes(lanes, s, u, g);
            TISSU_UNROLL
            for (int p = 0; p <= s; ++p) {
              if (p == s && kPairs == 0 && kNodes == 2) continue;  // an edge of Hooke has nothing there
              Batch K[9];
              Terms::node_pair(lanes, p, s, u, w, g, K);
              for (Batch& entry : K) entry = Batch(-scale) * entry;
              scatter_pair<kNodes>(lanes.slots, p, s, K, blocks);
            }
          }
        });
  }

  static void energy(const MassTensorView& view, const Chunk& chunk, const double* x, double* energies) {
    PackedNodes displacements;
    load_displacements(view, chunk, x, displacements);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t group, int lane) __attribute__((always_inline)) {
          Vectors u;
          Vectors Bu;
          Pairs q;
          Pairs w;
          lanes.gather(displacements, u);
          Terms::clear(Bu);
          Terms::products(u, q);
          Terms::weights(lanes, u, q, w);
          // The vectors' part is once in u . r and once in w . q, where the numbers' part stands twice.
          Terms::add_constant_part(lanes, u, q, Bu);
          Batch once(0.0);  // u . B u + vectors
          TISSU_UNROLL
          for (int a = 0; a < kNodes; ++a) once += Terms::dot(u[a], Bu[a]);
          Batch twice(0.0);  // vectors + numbers, twice
          TISSU_UNROLL
          for (int m = 0; m < kPairs; ++m) twice += w[m] * q[m];
          double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes + lane;
          (Batch::load(to) + Batch(0.5) * (once + twice)).store(to);
        });
  }

  static constexpr MassTensorKernels table() {
    return {kPairs == 0, kNodes, kReals, &force, &product, &stiffness, &energy};
  }
};

}  // namespace tissu::TISSU_KERNELS
