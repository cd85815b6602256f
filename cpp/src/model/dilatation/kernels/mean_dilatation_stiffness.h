#pragma once

/// What each cell gives to its patch's matrix, and the stress of the cells. At a point, with A = dP/dF at
/// Fbar, a = A : Fbar, n = (s/3) (a + P), d = (Fbar : a) / 9 + q / 3 (the second derivative of W by ln
/// theta),
///
///   K_cell: s^2 A - J' (G n + n G) + (J'^2 d - J'' q) G G + (pi - q J') dG/dF
///   m_a = sum_g w_g (n - J' d G) grad_a,   b_a = sum_g w_g G grad_a
///   slope = theta' / V,   curvature = (theta'^2 sum w d + theta'' Q) / V^2

#include "cell/kernels/shape_kernels.h"
#include "mean_dilatation.h"

namespace tissu::TISSU_KERNELS {

template <int N>
struct MeanDilatationStiffness : MeanDilatation<N> {
  using Base = MeanDilatation<N>;
  using Base::add;
  using Base::clear;
  using Base::gradient;
  using Base::kPairs;
  using Base::spread;
  using Base::tangent_index;
  using Base::weight;
  using typename Base::Nodal;
  using typename Base::Point;
  using typename Base::PointTangent;
  using typename Base::View;

  /// theta and the mean Q / V of every cell's patch.
  static void settle(const View& view, const Chunk& chunk, const PackedNodes& positions, ChunkLanes& theta,
                     ChunkLanes& Q) {
    alignas(64) Nodal position;
    alignas(64) Point P;
    DilatedPoint at;
    Base::dilatations(view, chunk, positions, theta);
    Q.clear();
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view.cells, group, positions, position);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        at.dilate(theta.of(chunk, group));
        Base::stress_at(view, group, at, P);
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          add(weight(view, group, g, lane) * Base::pressure(at, P, lane), Q.of(chunk, group) + lane);
        }
      }
    }
    Q.average(view, chunk);
  }

  /// a = A : Fbar
  TISSU_INLINE static void along_bar(const DilatedPoint& at, const PointTangent& A, int lane, Batch (&a)[9]) {
    for (int row = 0; row < 9; ++row) {
      Batch sum(0.0);
      for (int column = 0; column < 9; ++column) {
        sum += Batch::load(A[tangent_index(row, column)] + lane) * Batch::load(at.Fbar[column] + lane);
      }
      a[row] = sum;
    }
  }
  /// A -> K_cell at the point, P -> n - J' d G, D += w d; `mean` is Q / V of the patch.
  static void point_stiffness(const View& view, std::int32_t group, int g, const DilatedPoint& at,
                              const double* theta, const double* mean, PointTangent& A, Point& P, double* D) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      Batch a[9];
      along_bar(at, A, lane, a);
      const Batch q = Base::pressure(at, P, lane);
      Batch d = q * Batch(1.0 / 3.0);
      for (int k = 0; k < 9; ++k) d += a[k] * Batch::load(at.Fbar[k] + lane) * Batch(1.0 / 9.0);
      add(weight(view, group, g, lane) * d, D + lane);
      const Batch s = Batch::load(at.s + lane);
      const Batch slope = Batch::load(at.slope + lane);
      Batch n[9];
      Batch G[9];
      for (int k = 0; k < 9; ++k) {
        G[k] = Batch::load(at.G[k] + lane);
        n[k] = s * (a[k] + Batch::load(P[k] + lane)) * Batch(1.0 / 3.0);
        (n[k] - slope * d * G[k]).store(P[k] + lane);
      }
      const Batch of_GG = slope * slope * d - Batch::load(at.curvature + lane) * q;
      for (int row = 0; row < 9; ++row) {
        for (int column = row; column < 9; ++column) {
          double* to = A[tangent_index(row, column)] + lane;
          (s * s * Batch::load(to) - slope * (G[row] * n[column] + n[row] * G[column]) +
           of_GG * G[row] * G[column])
              .store(to);
        }
      }
      const Batch pi = Bounded(Batch::load(theta + lane)).slope * Batch::load(mean + lane);
      add_cofactors(at, pi - q * slope, lane, A);
    }
  }
  /// A += k dG/dF:  dG_ij/dF_kl = +-F_mn, where i, k, m and j, l, n are permutations of the three axes.
  static void add_cofactors(const DilatedPoint& at, Batch factor, int lane, PointTangent& A) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        for (int next = 1; next < 3; ++next) {
          for (int beside = 1; beside < 3; ++beside) {
            const int row = 3 * i + j;
            const int column = 3 * ((i + next) % 3) + (j + beside) % 3;
            if (column < row) continue;
            const Batch F = Batch::load(at.F[3 * ((i + 3 - next) % 3) + (j + 3 - beside) % 3] + lane);
            add(next == beside ? factor * F : -(factor * F), A[tangent_index(row, column)] + lane);
          }
        }
      }
    }
  }

  struct Cells {
    alignas(64) double K[kPairs][9][kLanes];
    alignas(64) Nodal m;
    alignas(64) Nodal b;
  };
  static void stiffness(const View& view, const Chunk& chunk, const double* x, const PatchParts& parts) {
    PackedNodes positions;
    ChunkLanes theta;
    ChunkLanes mean;
    ChunkLanes D;
    alignas(64) Nodal position;
    alignas(64) Point P;
    alignas(64) PointTangent A;
    DilatedPoint at;
    Cells cells;
    positions.load(chunk, x);
    settle(view, chunk, positions, theta, mean);
    D.clear();
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view.cells, group, positions, position);
      clear(cells);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        at.dilate(theta.of(chunk, group));
        Base::stress_at(view, group, at, P);
        clear(A);
        Base::for_laws(view, group, [&](const LawKernels& law, const double* constants) {
          law.tangent(constants, 1, at.Fbar[0], A[0]);
        });
        point_stiffness(view, group, g, at, theta.of(chunk, group), mean.of(chunk, group), A, P,
                        D.of(chunk, group));
        spread(view, group, g, 1.0, P, cells.m);
        spread(view, group, g, 1.0, at.G, cells.b);
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          Batch B[3][3][3][3];
          Base::pull_back(Base::rest_of(view.cells, group, g), view.cells.weights[g], lane, A, B);
          Base::add_pairs(Base::gradients_of(view.cells, g), B, lane, cells.K);
        }
      }
      hand_over(cells, (group - chunk.begin) * kLanes, parts);
    }
    D.average(view, chunk);
    factors(view, chunk, theta, mean, D, parts);
  }
  /// Lane after lane.
  static void hand_over(const Cells& cells, int first, const PatchParts& parts) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::ptrdiff_t at = first + lane;
      for (int k = 0; k < kPairs * 9; ++k) parts.matrices[at * kPairs * 9 + k] = cells.K[k / 9][k % 9][lane];
      for (int k = 0; k < N * 3; ++k) {
        parts.stresses[at * N * 3 + k] = cells.m[k / 3][k % 3][lane];
        parts.volumes[at * N * 3 + k] = cells.b[k / 3][k % 3][lane];
      }
    }
  }
  static void factors(const View& view, const Chunk& chunk, const ChunkLanes& theta, const ChunkLanes& mean,
                      const ChunkLanes& D, const PatchParts& parts) {
    const double* inverses = view.inverse_volumes + static_cast<std::ptrdiff_t>(chunk.begin) * kLanes;
    for (std::int32_t i = 0; i < (chunk.end - chunk.begin) * kLanes; i += kWidth) {
      const Bounded patch(Batch::load(theta.values + i));
      const Batch inverse = Batch::load(inverses + i);
      (patch.slope * inverse).store(parts.slopes + i);
      ((patch.slope * patch.slope * Batch::load(D.values + i) +
        patch.curvature * Batch::load(mean.values + i)) *
       inverse)
          .store(parts.curvatures + i);
    }
  }

  /// sigma = (s P + (pi - q J') G) F^T / J, and J, means over each cell.
  static void stress(const View& view, const Chunk& chunk, const double* x, double* stresses,
                     double* ratios) {
    PackedNodes positions;
    ChunkLanes theta;
    ChunkLanes pi;
    alignas(64) Nodal position;
    alignas(64) Point P;
    DilatedPoint at;
    positions.load(chunk, x);
    settle(view, chunk, positions, theta, pi);
    Base::pressures(chunk, theta, pi);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      alignas(64) double sum[7][kLanes];
      alignas(64) double volume[kLanes];
      alignas(64) double ignored[kLanes];
      clear(sum);
      clear(volume);
      clear(ignored);
      Base::gather_nodes(view.cells, group, positions, position);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        at.dilate(theta.of(chunk, group));
        Base::stress_at(view, group, at, P);
        Base::dilated_stress(view, group, g, at, P, ignored);
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          const Batch along = Batch::load(pi.of(chunk, group) + lane);
          for (int k = 0; k < 9; ++k) add(along * Batch::load(at.G[k] + lane), P[k] + lane);
          add(weight(view, group, g, lane), volume + lane);
        }
        for (int lane = 0; lane < kLanes; ++lane) {
          const double w = Base::rest_of(view.cells, group, g)[9 * kLanes + lane] * view.cells.weights[g];
          ShapeKernels<N, 3>::add_stress(at.F, P, w, lane, sum);
        }
      }
      double* to = stresses + static_cast<std::ptrdiff_t>(group) * 6 * kLanes;
      for (int l = 0; l < kLanes; ++l) {
        for (int s = 0; s < 6; ++s) to[s * kLanes + l] = sum[s][l] / volume[l];
        ratios[static_cast<std::ptrdiff_t>(group) * kLanes + l] = sum[6][l] / volume[l];
      }
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
