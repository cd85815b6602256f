#pragma once

/// Corotational linear elasticity: Hooke's law in the axes of each cell,
///   W = sum_g w_g (lambda / 2 tr(e_g)^2 + mu e_g : e_g) [J],  e_g = sym(R^T F_g) - I,  one R for a cell,
///   f_a = -R sum_g w_g sigma_g grad_a = -R sum_b K_ab (R^T x_b - X_b) [N],  df/dx = -R K R^T.
/// That leaves out that R follows x. With kExact it does not: the moment t = dW/dw of the stresses about the
/// cell adds -t . dw/dx to the force, and the tangent is the derivative of all (spin.h). For tetrahedra with
/// `polar` t vanishes; for other cells it is of second order in the part of the strain that is not uniform.
/// Sources: the force, Mueller and Gross, Interactive virtual materials, Graphics Interface 2004; the terms
/// of t and their derivative are worked out here.

#include "corotational_values.h"
#include "spin.h"

namespace tissu::TISSU_KERNELS {

template <class Element, class Rule, template <class> class LawOf, bool kExact>
struct Corotational : CorotationalValues<Element, Rule, LawOf> {
  using Values = CorotationalValues<Element, Rule, LawOf>;
  using Cell = CorotatedCell<Element, Rule, LawOf>;
  using Base = typename Cell::Base;
  using Centre = typename Cell::Centre;
  using Base::kNodes;
  using typename Cell::Inverse;
  using typename Cell::Nodal;

  TISSU_INLINE static Spin spin_of(const CorotationalView& view, const Cell& cell) {
    return {cell.A, view.rotation == Rotation::polar};
  }
  TISSU_INLINE static void clear(Batch (&t)[3]) { t[0] = t[1] = t[2] = Batch(0.0); }

  /// The force in the cell's axes, but for the part of t; adds t.
  TISSU_INLINE static void turned_force(const Cell& cell, Nodal& f, Batch (&t)[3]) {
    Base::clear(f);
    for (int g = 0; g < Rule::kPoints; ++g) {
      const Inverse Jinv = cell.lanes.inverse_jacobian(g);
      const Matrix shape = cell.shape_at(g, Jinv);
      const Matrix T = cell.stress_at(shape, -cell.lanes.weight(g));
      Base::spread(g, T, Jinv, f);
      if constexpr (kExact) add_moment(shape, T, t);
    }
  }
  /// Adds the force -k . l(B) of the changing rotation.
  TISSU_INLINE static void add_spin_force(const Cell& cell, const Spin& spin, const Batch (&k)[3], Nodal& f) {
    Nodal extra;
    Base::clear(extra);
    Centre::spread(0, spin.stress(k, Batch(-1.0)), cell.centre, extra);
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) f[a][i] += extra[a][i];
    }
  }

  static void force(const CorotationalView& view, const Chunk& chunk, const double* x, double* f) {
    if constexpr (Rule::kPoints == 1) {
      if (view.rotation == Rotation::polar) return Values::polar_force(view, chunk, x, f);
    }
    PackedNodes positions;
    PackedNodes sums;
    positions.load(chunk, x);
    sums.clear(chunk);
    for_batches(chunk, [&](std::int32_t group, int lane) {
      const Cell cell(view, positions, group, lane);
      Nodal result;
      Batch t[3];
      clear(t);
      turned_force(cell, result, t);
      if constexpr (kExact) {
        const Spin spin = spin_of(view, cell);
        Batch k[3];
        spin.transposed(t, k);
        add_spin_force(cell, spin, k, result);
      }
      cell.turn_out(result);
      cell.lanes.scatter_all(sums, result);
    });
    sums.add_to(chunk, f);
  }

  /// df = R K R^T p, times the scale.
  TISSU_INLINE static void change_of_force(const Cell& cell, double scale, const Nodal& q, Nodal& df) {
    Base::clear(df);
    for (int g = 0; g < Rule::kPoints; ++g) {
      const Inverse Jinv = cell.lanes.inverse_jacobian(g);
      const Matrix dT = cell.stress_change(Base::gradient(g, q, Jinv), cell.lanes.weight(g) * Batch(-scale));
      Base::spread(g, dT, Jinv, df);
    }
  }

  /// z_a = q_a - w x y_a: the change of y while R turns by w.
  TISSU_INLINE static void change_of_shape(const Cell& cell, const Nodal& q, const Batch (&w)[3], Nodal& z) {
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      Batch turned[3];
      cross(w, cell.y[a], turned);
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) z[a][i] = q[a][i] - turned[i];
    }
  }

  /// The change of the force and of t with the cell's shape; adds to dt.
  TISSU_INLINE static void change_with_shape(const Cell& cell, const Nodal& z, Nodal& df, Batch (&dt)[3]) {
    Base::clear(df);
    for (int g = 0; g < Rule::kPoints; ++g) {
      const Inverse Jinv = cell.lanes.inverse_jacobian(g);
      const Matrix shape = cell.shape_at(g, Jinv);
      const Matrix change = Base::gradient(g, z, Jinv);
      const Matrix dT = cell.stress_change(change, -cell.lanes.weight(g));
      Base::spread(g, dT, Jinv, df);
      add_moment(shape, dT, dt);
      add_moment(change, cell.stress_at(shape, -cell.lanes.weight(g)), dt);
    }
  }

  /// The same with all that follows from R following x.
  TISSU_INLINE static void exact_change(const CorotationalView& view, const Cell& cell, const Nodal& q,
                                        Nodal& df) {
    const Spin spin = spin_of(view, cell);
    Batch w[3];
    Batch t[3];
    Batch dt[3];
    Batch k[3];
    Batch dk[3];
    Nodal z;
    Nodal f;
    clear(t);
    clear(dt);
    spin.of(Centre::gradient(0, q, cell.centre), w);
    change_of_shape(cell, q, w, z);
    turned_force(cell, f, t);
    change_with_shape(cell, z, df, dt);
    spin.transposed(t, k);
    spin.add_change(Centre::gradient(0, z, cell.centre), k, -1.0, dt);
    spin.transposed(dt, dk);
    Base::close(f);
    Base::close(df);
    add_spin_force(cell, spin, k, f);
    add_spin_force(cell, spin, dk, df);
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      Batch turned[3];
      cross(w, f[a], turned);
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) df[a][i] += turned[i];
    }
  }

  static void product(const CorotationalView& view, const Chunk& chunk, const double* x, double scale,
                      const double* p, double* out) {
    PackedNodes positions;
    PackedNodes changes;
    PackedNodes sums;
    positions.load(chunk, x);
    changes.load(chunk, p);
    sums.clear(chunk);
    for_batches(chunk, [&](std::int32_t group, int lane) {
      const Cell cell(view, positions, group, lane);
      Nodal q;
      Nodal result;
      cell.lanes.gather_all(changes, q);
      cell.turn_in(q);
      if constexpr (kExact) {
        exact_change(view, cell, q, result);
        for (auto& node : result) {
          for (Batch& entry : node) entry = entry * Batch(scale);
        }
      } else {
        change_of_force(cell, scale, q, result);
      }
      cell.turn_out(result);
      cell.lanes.scatter_all(sums, result);
    });
    sums.add_to(chunk, out);
  }
};

}  // namespace tissu::TISSU_KERNELS
