#pragma once

/// E = sum_g w_g W(Fbar_g), one theta = v / V for each patch, v = sum_g w_g J_g. With P = dW/dF at Fbar,
/// q = P : Fbar / 3, ' the slope of ln rho and b = dv/dx:
///
///   f_a = -sum_g w_g (s P - q J' G) grad_a - pi b_a,   pi = theta' Q / V,   Q = sum_g w_g q_g
///
/// Three passes over the cells of a chunk: volumes, then the stress at Fbar, then the pressure pi; between
/// them the cells of each patch are put together.

#include "dilated_point.h"
#include "tissu/model/dilatation/mean_dilatation_kernels.h"

namespace tissu::TISSU_KERNELS {

/// Numbers of the cells of a chunk.
struct ChunkLanes {
  alignas(64) double values[kMostChunkCells];

  void clear() { __builtin_memset(values, 0, sizeof values); }
  double* of(const Chunk& chunk, std::int32_t group) {
    return values + static_cast<std::ptrdiff_t>(group - chunk.begin) * kLanes;
  }
  /// Gives every cell the sum of its patch.
  void share(const MeanDilatationView& view, const Chunk& chunk) {
    const std::int32_t first = chunk.begin * kLanes;
    for (std::int32_t p = view.first_patch[chunk.begin]; p < view.first_patch[chunk.end]; ++p) {
      double sum = 0.0;
      for (std::int32_t i = view.first_lane[p]; i < view.first_lane[p + 1]; ++i) {
        sum += values[view.lanes[i] - first];
      }
      for (std::int32_t i = view.first_lane[p]; i < view.first_lane[p + 1]; ++i) {
        values[view.lanes[i] - first] = sum;
      }
    }
  }
  /// That sum over the patch's volume at rest.
  void average(const MeanDilatationView& view, const Chunk& chunk) {
    share(view, chunk);
    const double* inverse = view.inverse_volumes + static_cast<std::ptrdiff_t>(chunk.begin) * kLanes;
    for (std::int32_t i = 0; i < (chunk.end - chunk.begin) * kLanes; ++i) values[i] *= inverse[i];
  }
};

template <int N>
struct MeanDilatation : Shape<N, 3> {
  using View = MeanDilatationView;
  using Base = Shape<N, 3>;
  using Base::gradients_of;
  using Base::rest_of;
  using typename Base::Nodal;
  using typename Base::Point;

  template <class Array>
  TISSU_INLINE static void clear(Array& values) {
    __builtin_memset(&values, 0, sizeof values);
  }
  static void gradient(const View& view, std::int32_t group, int g, const Nodal& u, Point& F) {
    Base::gradient(gradients_of(view.cells, g), rest_of(view.cells, group, g), u, F);
  }
  static void spread(const View& view, std::int32_t group, int g, double scale, const Point& P, Nodal& f) {
    Base::spread(gradients_of(view.cells, g), rest_of(view.cells, group, g), scale * view.cells.weights[g], P,
                 f);
  }
  TISSU_INLINE static Batch weight(const View& view, std::int32_t group, int g, int lane) {
    return Batch::load(rest_of(view.cells, group, g) + 9 * kLanes + lane) * Batch(view.cells.weights[g]);
  }
  TISSU_INLINE static void add(Batch value, double* to) { (Batch::load(to) + value).store(to); }

  /// Calls f(law, its constants) for each law of the group.
  template <class Function>
  TISSU_INLINE static void for_laws(const View& view, std::int32_t group, Function&& f) {
    const double* constants = view.cells.constants + group * view.cells.constants_stride;
    for (int l = 0; l < view.cells.law_count; ++l) {
      f(*view.cells.laws[l], constants);
      constants += static_cast<std::ptrdiff_t>(view.cells.laws[l]->constants) * kLanes;
    }
  }
  static void stress_at(const View& view, std::int32_t group, const DilatedPoint& at, Point& P) {
    clear(P);
    for_laws(view, group,
             [&](const LawKernels& law, const double* c) { law.stress(c, 1, at.Fbar[0], P[0]); });
  }

  /// theta of every cell's patch.
  static void dilatations(const View& view, const Chunk& chunk, const PackedNodes& positions,
                          ChunkLanes& theta) {
    alignas(64) Nodal position;
    DilatedPoint at;
    theta.clear();
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view.cells, group, positions, position);
      double* v = theta.of(chunk, group);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        at.measure();
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          add(weight(view, group, g, lane) * Batch::load(at.J + lane), v + lane);
        }
      }
    }
    theta.average(view, chunk);
  }

  /// q of a point, P at Fbar.
  TISSU_INLINE static Batch pressure(const DilatedPoint& at, const Point& P, int lane) {
    return DilatedPoint::dot(P, at.Fbar, lane) * Batch(1.0 / 3.0);
  }
  /// P = s P - q J' G, and Q += w q
  static void dilated_stress(const View& view, std::int32_t group, int g, const DilatedPoint& at, Point& P,
                             double* Q) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const Batch q = pressure(at, P, lane);
      add(weight(view, group, g, lane) * q, Q + lane);
      const Batch s = Batch::load(at.s + lane);
      const Batch along = q * Batch::load(at.slope + lane);
      for (int k = 0; k < 9; ++k) {
        (s * Batch::load(P[k] + lane) - along * Batch::load(at.G[k] + lane)).store(P[k] + lane);
      }
    }
  }
  /// pi = theta' Q / V for the mean Q / V of a patch.
  static void pressures(const Chunk& chunk, ChunkLanes& theta, ChunkLanes& Q) {
    for (std::int32_t i = 0; i < (chunk.end - chunk.begin) * kLanes; i += kWidth) {
      const Bounded patch(Batch::load(theta.values + i));
      (patch.slope * Batch::load(Q.values + i)).store(Q.values + i);
    }
  }
  /// P = pi G
  static void pressure_stress(const DilatedPoint& at, const double* pi, Point& P) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      for (int k = 0; k < 9; ++k) (Batch::load(pi + lane) * Batch::load(at.G[k] + lane)).store(P[k] + lane);
    }
  }

  static void force(const View& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes positions;
    PackedNodes sums;
    ChunkLanes theta;
    ChunkLanes Q;
    alignas(64) Nodal position;
    alignas(64) Nodal result;
    alignas(64) Point P;
    DilatedPoint at;
    positions.load(chunk, x);
    sums.clear(chunk);
    dilatations(view, chunk, positions, theta);
    Q.clear();
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view.cells, group, positions, position);
      clear(result);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        at.dilate(theta.of(chunk, group));
        stress_at(view, group, at, P);
        dilated_stress(view, group, g, at, P, Q.of(chunk, group));
        spread(view, group, g, -1.0, P, result);
      }
      Base::scatter_nodes(view.cells, group, result, sums);
    }
    Q.average(view, chunk);
    pressures(chunk, theta, Q);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view.cells, group, positions, position);
      clear(result);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        at.measure();
        pressure_stress(at, Q.of(chunk, group), P);
        spread(view, group, g, -1.0, P, result);
      }
      Base::scatter_nodes(view.cells, group, result, sums);
    }
    sums.add_to(chunk, f);
  }

  static void energy(const View& view, const Chunk& chunk, const double* x, double* energies) {
    PackedNodes positions;
    ChunkLanes theta;
    alignas(64) Nodal position;
    alignas(64) double W[kLanes];
    DilatedPoint at;
    positions.load(chunk, x);
    dilatations(view, chunk, positions, theta);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes;
      Base::gather_nodes(view.cells, group, positions, position);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        at.dilate(theta.of(chunk, group));
        clear(W);
        for_laws(view, group,
                 [&](const LawKernels& law, const double* c) { law.energy(c, 1, at.Fbar[0], W); });
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          add(weight(view, group, g, lane) * Batch::load(W + lane), to + lane);
        }
      }
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
