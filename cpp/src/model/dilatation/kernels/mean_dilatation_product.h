#pragma once

/// df/dx times a change p of the positions. With dF the change of F, dl that of ln s and dJ = G : dF,
///
///   dl = (theta' dtheta - J' dJ) / 3,   dFbar = s (dF + dl F),   dP = dP/dFbar : dFbar,
///   dq = (dP : Fbar + P : dFbar) / 3,   dG = F x dF,
///   d(stress) = s (dl P + dP) - (dq J' + q J'' dJ) G - q J' dG + dpi G + pi dG,
///   dpi = (theta' dQ + theta'' dtheta Q) / V

#include "mean_dilatation.h"

namespace tissu::TISSU_KERNELS {

template <int N>
struct MeanDilatationProduct : MeanDilatation<N> {
  using Base = MeanDilatation<N>;
  using Base::add;
  using Base::clear;
  using Base::gradient;
  using Base::spread;
  using Base::weight;
  using typename Base::Nodal;
  using typename Base::Point;
  using typename Base::View;

  /// theta of every cell's patch, and its change.
  static void dilatations(const View& view, const Chunk& chunk, const PackedNodes& positions,
                          const PackedNodes& changes, ChunkLanes& theta, ChunkLanes& dtheta) {
    alignas(64) Nodal position;
    alignas(64) Nodal change;
    alignas(64) Point dF;
    DilatedPoint at;
    theta.clear();
    dtheta.clear();
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view.cells, group, positions, position);
      Base::gather_nodes(view.cells, group, changes, change);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        gradient(view, group, g, change, dF);
        at.measure();
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          const Batch w = weight(view, group, g, lane);
          add(w * Batch::load(at.J + lane), theta.of(chunk, group) + lane);
          add(w * DilatedPoint::dot(at.G, dF, lane), dtheta.of(chunk, group) + lane);
        }
      }
    }
    theta.average(view, chunk);
    dtheta.average(view, chunk);
  }

  /// dl in `change`, and dFbar.
  static void dilate_change(const DilatedPoint& at, const double* theta, const double* dtheta,
                            const Point& dF, Point& dFbar, double* change) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const Batch dJ = DilatedPoint::dot(at.G, dF, lane);
      const Batch along = Bounded(Batch::load(theta + lane)).slope * Batch::load(dtheta + lane);
      const Batch dl = (along - Batch::load(at.slope + lane) * dJ) * Batch(1.0 / 3.0);
      dl.store(change + lane);
      const Batch s = Batch::load(at.s + lane);
      for (int k = 0; k < 9; ++k) {
        (s * (Batch::load(dF[k] + lane) + dl * Batch::load(at.F[k] + lane))).store(dFbar[k] + lane);
      }
    }
  }
  struct Change {
    alignas(64) Point dF;
    alignas(64) Point dFbar;
    alignas(64) Point P;
    alignas(64) Point dP;
    alignas(64) double dl[kLanes];
  };
  /// dP becomes the change of stress but for the part of pi; Q += w q, dQ += w dq.
  static void change_stress(const View& view, std::int32_t group, int g, const DilatedPoint& at, Change& c,
                            double* Q, double* dQ) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const Batch w = weight(view, group, g, lane);
      const Batch q = Base::pressure(at, c.P, lane);
      const Batch dq =
          Base::pressure(at, c.dP, lane) + DilatedPoint::dot(c.P, c.dFbar, lane) * Batch(1.0 / 3.0);
      add(w * q, Q + lane);
      add(w * dq, dQ + lane);
      const Batch dJ = DilatedPoint::dot(at.G, c.dF, lane);
      const Batch slope = Batch::load(at.slope + lane);
      const Batch of_G = dq * slope + q * Batch::load(at.curvature + lane) * dJ;
      const Batch s = Batch::load(at.s + lane);
      const Batch dl = Batch::load(c.dl + lane);
      for (int k = 0; k < 9; ++k) {
        const Batch bar = s * (dl * Batch::load(c.P[k] + lane) + Batch::load(c.dP[k] + lane));
        const Batch dG = DilatedPoint::cross(at.F, c.dF, k / 3, k % 3, lane);
        (bar - of_G * Batch::load(at.G[k] + lane) - q * slope * dG).store(c.dP[k] + lane);
      }
    }
  }
  /// Q and dQ, means over the patch, become pi and dpi.
  static void pressures(const Chunk& chunk, const ChunkLanes& theta, const ChunkLanes& dtheta, ChunkLanes& Q,
                        ChunkLanes& dQ) {
    for (std::int32_t i = 0; i < (chunk.end - chunk.begin) * kLanes; i += kWidth) {
      const Bounded patch(Batch::load(theta.values + i));
      const Batch mean = Batch::load(Q.values + i);
      (patch.slope * Batch::load(dQ.values + i) + patch.curvature * Batch::load(dtheta.values + i) * mean)
          .store(dQ.values + i);
      (patch.slope * mean).store(Q.values + i);
    }
  }
  /// dP = dpi G + pi dG
  static void change_pressure(const DilatedPoint& at, const Point& dF, const double* pi, const double* dpi,
                              Point& dP) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      for (int k = 0; k < 9; ++k) {
        const Batch dG = DilatedPoint::cross(at.F, dF, k / 3, k % 3, lane);
        (Batch::load(dpi + lane) * Batch::load(at.G[k] + lane) + Batch::load(pi + lane) * dG)
            .store(dP[k] + lane);
      }
    }
  }

  static void product(const View& view, const Chunk& chunk, const double* x, double scale, const double* p,
                      double* out) {
    PackedNodes positions;
    PackedNodes changes;
    PackedNodes sums;
    ChunkLanes theta;
    ChunkLanes dtheta;
    positions.load(chunk, x);
    changes.load(chunk, p);
    sums.clear(chunk);
    dilatations(view, chunk, positions, changes, theta, dtheta);
    ChunkLanes Q;
    ChunkLanes dQ;
    Q.clear();
    dQ.clear();
    for_changes(view, chunk, positions, changes, sums,
                [&](std::int32_t group, int g, DilatedPoint& at, Change& c, Nodal& result) {
                  at.dilate(theta.of(chunk, group));
                  dilate_change(at, theta.of(chunk, group), dtheta.of(chunk, group), c.dF, c.dFbar, c.dl);
                  Base::stress_at(view, group, at, c.P);
                  clear(c.dP);
                  Base::for_laws(view, group, [&](const LawKernels& law, const double* constants) {
                    law.stress_change(constants, 1, at.Fbar[0], c.dFbar[0], c.dP[0]);
                  });
                  change_stress(view, group, g, at, c, Q.of(chunk, group), dQ.of(chunk, group));
                  spread(view, group, g, -scale, c.dP, result);
                });
    Q.average(view, chunk);
    dQ.average(view, chunk);
    pressures(chunk, theta, dtheta, Q, dQ);
    for_changes(view, chunk, positions, changes, sums,
                [&](std::int32_t group, int g, DilatedPoint& at, Change& c, Nodal& result) {
                  at.measure();
                  change_pressure(at, c.dF, Q.of(chunk, group), dQ.of(chunk, group), c.dP);
                  spread(view, group, g, -scale, c.dP, result);
                });
    sums.add_to(chunk, out);
  }

  /// Calls f(group, point, F there, dF there, result) for every point of the chunk's cells; sums the results.
  template <class Function>
  static void for_changes(const View& view, const Chunk& chunk, const PackedNodes& positions,
                          const PackedNodes& changes, PackedNodes& sums, Function&& f) {
    alignas(64) Nodal position;
    alignas(64) Nodal change;
    alignas(64) Nodal result;
    DilatedPoint at;
    Change c;
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      Base::gather_nodes(view.cells, group, positions, position);
      Base::gather_nodes(view.cells, group, changes, change);
      clear(result);
      for (int g = 0; g < view.cells.points; ++g) {
        gradient(view, group, g, position, at.F);
        gradient(view, group, g, change, c.dF);
        f(group, g, at, c, result);
      }
      Base::scatter_nodes(view.cells, group, result, sums);
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
