#pragma once

/// The loops over elements of N nodes and reference dimension M, for any quadrature and any law: at each
/// point the law is called for the eight elements of a group. Next to elastic.h, which is compiled for one
/// element, quadrature and law and keeps F in registers, it costs a pass through the first-level cache.

#include "point_laws.h"
#include "shape.h"

namespace tissu::TISSU_KERNELS {

template <int N, int M>
struct ShapeKernels : Shape<N, M> {
  using Base = Shape<N, M>;
  using Base::gradients_of;
  using Base::rest_of;
  using typename Base::Nodal;
  using typename Base::Point;
  using typename Base::PointTangent;

  template <class Array>
  TISSU_INLINE static void clear(Array& values) {
    __builtin_memset(&values, 0, sizeof values);
  }

  /// F at a point, in the axes that the laws work in.
  static void deformation(const ElasticView& view, std::int32_t group, int point, const Nodal& u, Point& F) {
    Base::gradient(gradients_of(view, point), rest_of(view, group, point), u, F);
    Base::turn_in(view, group, point, F);
  }
  static void spread_from(const ElasticView& view, std::int32_t group, int point, double scale, Point& P,
                          Nodal& f) {
    Base::turn_out(view, group, point, P);
    Base::spread(gradients_of(view, point), rest_of(view, group, point), scale * view.weights[point], P, f);
  }

  static void force(const ElasticView& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes positions;
    PackedNodes sums;
    alignas(64) Nodal position;
    alignas(64) Nodal result;
    alignas(64) Point F;
    alignas(64) Point P;
    positions.load(chunk, x);
    sums.clear(chunk);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view, group, positions, position);
      clear(result);
      for (int g = 0; g < view.points; ++g) {
        deformation(view, group, g, position, F);
        view.at_point->stress(view, group, g, F[0], P[0]);
        spread_from(view, group, g, -1.0, P, result);
      }
      Base::scatter_nodes(view, group, result, sums);
    }
    sums.add_to(chunk, f);
  }

  static void product(const ElasticView& view, const Chunk& chunk, const double* x, double scale,
                      const double* p, double* out) {
    PackedNodes positions;
    PackedNodes changes;
    PackedNodes sums;
    alignas(64) Nodal position;
    alignas(64) Nodal change;
    alignas(64) Nodal result;
    alignas(64) Point F;
    alignas(64) Point dF;
    alignas(64) Point dP;
    positions.load(chunk, x);
    changes.load(chunk, p);
    sums.clear(chunk);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view, group, positions, position);
      Base::gather_nodes(view, group, changes, change);
      clear(result);
      for (int g = 0; g < view.points; ++g) {
        deformation(view, group, g, position, F);
        deformation(view, group, g, change, dF);
        view.at_point->stress_change(view, group, g, F[0], dF[0], dP[0]);
        spread_from(view, group, g, -scale, dP, result);
      }
      Base::scatter_nodes(view, group, result, sums);
    }
    sums.add_to(chunk, out);
  }

  /// Of dP/dF, or of what stands in its place.
  [[gnu::noinline]] static void assemble(decltype(PointLaws::tangent) tangent, const ElasticView& view,
                                         const Chunk& chunk, const double* x, double scale, double* blocks) {
    PackedNodes positions;
    alignas(64) Nodal position;
    alignas(64) Point F;
    alignas(64) PointTangent A;
    alignas(64) double K[Base::kPairs][9][kLanes];
    positions.load(chunk, x);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view, group, positions, position);
      clear(K);
      for (int g = 0; g < view.points; ++g) {
        deformation(view, group, g, position, F);
        tangent(view, group, g, F[0], A[0]);
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          Batch B[3][M][3][M];
          Base::pull_back(rest_of(view, group, g), -scale * view.weights[g], lane, A, B);
          Base::turn_out(view, group, g, lane, B);
          Base::add_pairs(gradients_of(view, g), B, lane, K);
        }
      }
      Base::scatter_pairs(view, group, K, blocks);
    }
  }
  static void stiffness(const ElasticView& view, const Chunk& chunk, const double* x, double scale,
                        double* blocks) {
    assemble(view.at_point->tangent, view, chunk, x, scale, blocks);
  }
  static void definite(const ElasticView& view, const Chunk& chunk, const double* x, double scale,
                       double* blocks) {
    assemble(view.at_point->definite, view, chunk, x, scale, blocks);
  }

  static void energy(const ElasticView& view, const Chunk& chunk, const double* x, double* energies) {
    PackedNodes positions;
    alignas(64) Nodal position;
    alignas(64) Point F;
    alignas(64) double W[kLanes];
    positions.load(chunk, x);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes;
      Base::gather_nodes(view, group, positions, position);
      for (int g = 0; g < view.points; ++g) {
        const double* volume = rest_of(view, group, g) + M * M * kLanes;
        deformation(view, group, g, position, F);
        clear(W);
        LawsOfGroup::for_each(view, group, g,
                              [&](const LawKernels& law, const double* c) { law.energy(c, 1, F[0], W); });
        for (int lane = 0; lane < kLanes; ++lane) to[lane] += view.weights[g] * volume[lane] * W[lane];
      }
    }
  }

  /// sigma = P F^T / J, weighted with the rest volume; J is sqrt(det F^T F), with the sign of det F for a
  /// volume: below three dimensions the thickness or section is taken as it was at rest.
  static void stress(const ElasticView& view, const Chunk& chunk, const double* x, double* stresses,
                     double* ratios) {
    PackedNodes positions;
    alignas(64) Nodal position;
    alignas(64) Point F;
    alignas(64) Point P;
    positions.load(chunk, x);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      alignas(64) double sum[7][kLanes];
      double volume[kLanes];
      clear(sum);
      clear(volume);
      Base::gather_nodes(view, group, positions, position);
      for (int g = 0; g < view.points; ++g) {
        const double* measure = rest_of(view, group, g) + M * M * kLanes;
        deformation(view, group, g, position, F);
        view.at_point->stress(view, group, g, F[0], P[0]);
        Base::turn_out(view, group, g, F);
        Base::turn_out(view, group, g, P);
        for (int lane = 0; lane < kLanes; ++lane) {
          volume[lane] += view.weights[g] * measure[lane];
          add_stress(F, P, view.weights[g] * measure[lane], lane, sum);
        }
      }
      double* to = stresses + static_cast<std::ptrdiff_t>(group) * 6 * kLanes;
      for (int l = 0; l < kLanes; ++l) {
        for (int s = 0; s < 6; ++s) to[s * kLanes + l] = sum[s][l] / volume[l];
        ratios[static_cast<std::ptrdiff_t>(group) * kLanes + l] = sum[6][l] / volume[l];
      }
    }
  }

  /// Adds w sigma (xx yy zz yz xz xy) and w J of one lane.
  static void add_stress(const Point& F, const Point& P, double w, int lane, double (&sum)[7][kLanes]) {
    constexpr int row[6] = {0, 1, 2, 1, 0, 0};
    constexpr int column[6] = {0, 1, 2, 2, 2, 1};
    const double J = Base::volume_ratio(F, lane);
    sum[6][lane] += w * J;
    for (int s = 0; s < 6; ++s) {
      double tau = 0.0;
      for (int j = 0; j < M; ++j) {
        tau += 0.5 * (P[M * row[s] + j][lane] * F[M * column[s] + j][lane] +
                      P[M * column[s] + j][lane] * F[M * row[s] + j][lane]);
      }
      sum[s][lane] += w / J * tau;
    }
  }

  static constexpr ElasticKernels table(const PointLaws* at_point) {
    return {"", "", "", N, M, &force, &product, &stiffness, &energy, &stress, false, &definite, at_point};
  }
};

}  // namespace tissu::TISSU_KERNELS
