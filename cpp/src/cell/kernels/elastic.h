#pragma once

/// One text for every element, quadrature, law and instruction set: F from the nodes, the law at the point,
/// the force back to the nodes.  f_a = -sum_g w_g P grad_a,  K_ab = sum_g w_g grad_a . dP/dF . grad_b.

#include "definite_tangent.h"
#include "for_batches.h"
#include "fused_point.h"
#include "pair_stiffness.h"
#include "scatter_pairs.h"

namespace tissu::TISSU_KERNELS {

using DefiniteLoop = decltype(ElasticKernels::definite);

template <class Element, class Rule, template <class> class LawOf>
struct Elastic : FusedPoint<Element, Rule, LawOf> {
  using Base = FusedPoint<Element, Rule, LawOf>;
  using Base::kNodes;
  using typename Base::Inverse;
  using typename Base::Lanes;
  using typename Base::MaterialLaw;
  using typename Base::Tensor;

  static void force(const ElasticView& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes positions;
    PackedNodes sums;
    positions.load(chunk, x);
    sums.clear(chunk);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          Batch position[kNodes][3];
          Batch result[kNodes][3];
          lanes.gather_all(positions, position);
          Base::clear(result);
          for (int g = 0; g < Rule::kPoints; ++g) {
            const Inverse Jinv = lanes.inverse_jacobian(g);
            const Tensor F = Base::gradient(g, position, Jinv);
            Base::spread(g,
                         Base::scaled(lanes.law, -lanes.weight(g),
                                      [&](const MaterialLaw& law) { return law.stress(F); }),
                         Jinv, result);
          }
          Base::close(result);
          lanes.scatter_all(sums, result);
        });
    sums.add_to(chunk, f);
  }

  static void product(const ElasticView& view, const Chunk& chunk, const double* x, double scale,
                      const double* p, double* out) {
    PackedNodes positions;
    PackedNodes changes;
    PackedNodes sums;
    positions.load(chunk, x);
    changes.load(chunk, p);
    sums.clear(chunk);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          Batch position[kNodes][3];
          Batch change[kNodes][3];
          Batch result[kNodes][3];
          lanes.gather_all(positions, position);
          lanes.gather_all(changes, change);
          Base::clear(result);
          for (int g = 0; g < Rule::kPoints; ++g) {
            const Inverse Jinv = lanes.inverse_jacobian(g);
            const Tensor F = Base::gradient(g, position, Jinv);
            const Tensor dF = Base::gradient(g, change, Jinv);
            Base::spread(g,
                         Base::scaled(lanes.law, lanes.weight(g) * Batch(-scale),
                                      [&](const MaterialLaw& law) { return law.stress_change(F, dF); }),
                         Jinv, result);
          }
          Base::close(result);
          lanes.scatter_all(sums, result);
        });
    sums.add_to(chunk, out);
  }

  /// grad_a N at a point: J^-T dN_a/dxi
  TISSU_INLINE static void rest_gradients(int point, const Inverse& Jinv, Batch (&grad)[kNodes][3]) {
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) Jinv.rest_gradient(Base::kTable.dN[point][a], grad[a]);
  }

  /// half(i, J, k) = A_iJkL grad_b[L]
  TISSU_INLINE static void contract(const Tangent<Batch>& A, const Batch (&grad)[3], Batch (&half)[3][3][3]) {
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int J = 0; J < 3; ++J) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          half[i][J][k] = A(i, J, k, 0) * grad[0] + A(i, J, k, 1) * grad[1] + A(i, J, k, 2) * grad[2];
        }
      }
    }
  }

  static constexpr int kFirst =
      Element::kAffine ? 1 : 0;  ///< node 0 of an affine cell follows from the others
  static constexpr int kPairs = (kNodes - kFirst) * (kNodes - kFirst + 1) / 2;

  template <bool kDefinite>
  TISSU_INLINE static void point_stiffness(const Lanes& lanes, int g, const Batch (&position)[kNodes][3],
                                           double scale, Batch (&K)[kPairs][9]) {
    const Inverse Jinv = lanes.inverse_jacobian(g);
    const Tensor F = Base::gradient(g, position, Jinv);
    if constexpr (PairStiffness<MaterialLaw>::kHas && !kDefinite) {
      Batch grad[kNodes][3];
      rest_gradients(g, Jinv, grad);
      PairStiffness<MaterialLaw>(lanes.law, F, lanes.weight(g) * Batch(-scale)).template add<kFirst>(grad, K);
      return;
    }
    Tangent<Batch> A;
    if constexpr (kDefinite) {
      PrincipalAxes axes;
      axes.find(F);
      A = lanes.law.tangent(axes.stretch);
      axes.make_definite(A);
    } else {
      A = lanes.law.tangent(F);
    }
    const Batch s = lanes.weight(g) * Batch(-scale);
    for (Batch& a : A.a) a = a * s;
    Batch grad[kNodes][3];
    rest_gradients(g, Jinv, grad);
    int pair = 0;
    for (int b = kFirst; b < kNodes; ++b) {
      Batch half[3][3][3];
      contract(A, grad[b], half);
      for (int a = kFirst; a <= b; ++a, ++pair) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          TISSU_UNROLL
          for (int i = 0; i < 3; ++i) {
            K[pair][3 * k + i] +=
                half[i][0][k] * grad[a][0] + half[i][1][k] * grad[a][1] + half[i][2][k] * grad[a][2];
          }
        }
      }
    }
  }

  template <bool kDefinite>
  static void stiffness(const ElasticView& view, const Chunk& chunk, const double* x, double scale,
                        double* blocks) {
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t, int) __attribute__((always_inline)) {
          Batch position[kNodes][3];
          Batch K[kPairs][9];
          fetch_pairs<kNodes>(lanes.slots, blocks);
          lanes.gather_all(positions, position);
          for (auto& block : K) {
            for (Batch& entry : block) entry = Batch(0.0);
          }
          for (int g = 0; g < Rule::kPoints; ++g) point_stiffness<kDefinite>(lanes, g, position, scale, K);
          int pair = 0;
          for (int b = kFirst; b < kNodes; ++b) {
            for (int a = kFirst; a <= b; ++a, ++pair)
              scatter_pair<kNodes>(lanes.slots, a, b, K[pair], blocks);
          }
          if constexpr (Element::kAffine) scatter_first_node<kNodes>(lanes.slots, K, blocks);
        });
  }

  static void energy(const ElasticView& view, const Chunk& chunk, const double* x, double* energies) {
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t group, int lane) __attribute__((always_inline)) {
          Batch position[kNodes][3];
          lanes.gather_all(positions, position);
          Batch sum(0.0);
          for (int g = 0; g < Rule::kPoints; ++g) {
            sum += lanes.weight(g) * lanes.law.energy(Base::gradient(g, position, lanes.inverse_jacobian(g)));
          }
          double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes + lane;
          (Batch::load(to) + sum).store(to);
        });
  }

  /// sigma = P F^T / det F, weighted with the rest volume.
  static void stress(const ElasticView& view, const Chunk& chunk, const double* x, double* stresses,
                     double* ratios) {
    constexpr int row[6] = {0, 1, 2, 1, 0, 0};
    constexpr int column[6] = {0, 1, 2, 2, 2, 1};
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches<Lanes>(
        view, chunk, [&](const Lanes& lanes, std::int32_t group, int lane) __attribute__((always_inline)) {
          Batch position[kNodes][3];
          lanes.gather_all(positions, position);
          Batch volume(0.0);
          Batch ratio(0.0);
          Batch sum[6];
          for (Batch& s : sum) s = Batch(0.0);
          for (int g = 0; g < Rule::kPoints; ++g) {
            const Tensor F = Base::gradient(g, position, lanes.inverse_jacobian(g));
            const Batch J = determinant(F);
            const Tensor tau = tissu::product_transposed(lanes.law.stress(F), F);
            const Batch w = lanes.weight(g);
            volume += w;
            ratio += w * J;
            TISSU_UNROLL
            for (int s = 0; s < 6; ++s)
              sum[s] += w / J * (tau(row[s], column[s]) + tau(column[s], row[s])) * Batch(0.5);
          }
          double* to = stresses + static_cast<std::ptrdiff_t>(group) * 6 * kLanes + lane;
          TISSU_UNROLL
          for (int s = 0; s < 6; ++s) (sum[s] / volume).store(to + s * kLanes);
          (ratio / volume).store(ratios + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
        });
  }

  /// A law that is linear has a tangent without negative eigenvalues; the others here are isotropic.
  static constexpr DefiniteLoop definite() {
    if constexpr (MaterialLaw::kLinear) {
      return nullptr;
    } else {
      static_assert(MaterialLaw::kIsotropic);
      return &stiffness<true>;
    }
  }

  static constexpr ElasticKernels table(std::string_view quadrature) {
    return {Element::kName,
            MaterialLaw::kName,
            quadrature,
            kNodes,
            3,
            &force,
            &product,
            &stiffness<false>,
            &energy,
            &stress,
            MaterialLaw::kIsotropic,
            definite()};
  }
};

}  // namespace tissu::TISSU_KERNELS
