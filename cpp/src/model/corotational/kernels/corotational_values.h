#pragma once

/// What is the same whether the tangent counts that R follows x, or not: energy, stress, and the force where
/// the moment t vanishes. Apart from corotational.h it is compiled once for both.

#include "corotated_cell.h"

namespace tissu::TISSU_KERNELS {

template <class Element, class Rule, template <class> class LawOf>
struct CorotationalValues : CorotatedCell<Element, Rule, LawOf> {
  using Cell = CorotatedCell<Element, Rule, LawOf>;
  using Base = typename Cell::Base;
  using typename Cell::Inverse;
  using typename Cell::Nodal;

  /// A cell of one point with `polar`: P = 2 mu (F - R) + lambda (tr(R^T F) - 3) R.
  static void polar_force(const CorotationalView& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes positions;
    PackedNodes sums;
    positions.load(chunk, x);
    sums.clear(chunk);
    for_batches(chunk, [&](std::int32_t group, int lane) {
      const typename Base::Lanes lanes(view.cells, group, lane);
      const Inverse Jinv = lanes.inverse_jacobian(0);
      Nodal u;
      lanes.gather_all(positions, u);
      const Matrix F = Base::gradient(0, u, Jinv);
      Batch trace;
      Matrix P = polar_rotation(F, trace);
      const Batch w = -lanes.weight(0);
      const Batch two_mu = w * Batch(2.0) * lanes.law.mu;
      const Batch of_R = w * lanes.law.lambda * (trace - Batch(3.0)) - two_mu;
      TISSU_UNROLL
      for (int k = 0; k < 9; ++k) P.m[k / 3][k % 3] = two_mu * F.m[k / 3][k % 3] + of_R * P.m[k / 3][k % 3];
      Base::clear(u);
      Base::spread(0, P, Jinv, u);
      Base::close(u);
      lanes.scatter_all(sums, u);
    });
    sums.add_to(chunk, f);
  }

  static void energy(const CorotationalView& view, const Chunk& chunk, const double* x, double* energies) {
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches(chunk, [&](std::int32_t group, int lane) {
      const Cell cell(view, positions, group, lane);
      Batch sum(0.0);
      for (int g = 0; g < Rule::kPoints; ++g) {
        const Inverse Jinv = cell.lanes.inverse_jacobian(g);
        sum += cell.lanes.weight(g) * cell.lanes.law.energy(cell.shape_at(g, Jinv));
      }
      double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes + lane;
      (Batch::load(to) + sum).store(to);
    });
  }

  /// Cauchy's stress R sigma R^T and det F, weighted with the rest volume.
  static void stress(const CorotationalView& view, const Chunk& chunk, const double* x, double* stresses,
                     double* ratios) {
    constexpr int row[6] = {0, 1, 2, 1, 0, 0};
    constexpr int column[6] = {0, 1, 2, 2, 2, 1};
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches(chunk, [&](std::int32_t group, int lane) {
      const Cell cell(view, positions, group, lane);
      Batch volume(0.0);
      Batch ratio(0.0);
      Matrix sum;
      for (int k = 0; k < 9; ++k) sum.m[k / 3][k % 3] = Batch(0.0);
      for (int g = 0; g < Rule::kPoints; ++g) {
        const Matrix shape = cell.shape_at(g, cell.lanes.inverse_jacobian(g));
        const Batch w = cell.lanes.weight(g);
        const Matrix T = cell.stress_at(shape, w);
        volume += w;
        ratio += w * determinant(shape);
        for (int k = 0; k < 9; ++k) sum.m[k / 3][k % 3] += T.m[k / 3][k % 3];
      }
      const Matrix turned = product_transposed(tissu::product(cell.R, sum), cell.R);
      double* to = stresses + static_cast<std::ptrdiff_t>(group) * 6 * kLanes + lane;
      for (int s = 0; s < 6; ++s) (turned(row[s], column[s]) / volume).store(to + s * kLanes);
      (ratio / volume).store(ratios + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
    });
  }
};

}  // namespace tissu::TISSU_KERNELS
