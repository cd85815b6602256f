#pragma once

/// What a body is made of: a force model that owns a block of cells, their masses and their fields.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/force/force_model.h"
#include "tissu/model/elastic_block.h"
#include "tissu/model/point_fields.h"

namespace tissu {

class CellEditor;

/// Mean values over each cell, in the order of the block's cells; empty where the model does not know them.
struct CellFields {
  std::vector<double> von_mises;       ///< of the Cauchy stress [Pa]
  std::vector<double> energy_density;  ///< per rest volume [J/m3]
  std::vector<double> volume_ratio;    ///< det F, of sheets and lines too: they thin
};

/// Springs with whose direction dampers may stand beside them: Kelvin–Voigt of a model that is made of
/// springs.
class DampedSprings {
 public:
  DampedSprings() = default;
  DampedSprings(const DampedSprings&) = delete;
  DampedSprings& operator=(const DampedSprings&) = delete;
  /// sum_e V_e / l0^2 of each lane [m], [group][8]
  [[nodiscard]] virtual const AlignedVector<double>& shares() const = 0;
  /// out += scale times the force of dampers [N s/m] of each lane at the velocities p, …
  virtual void add_damping(const double* damping, ConstReals x, double scale, ConstReals p,
                           Reals out) const = 0;
  /// … and its matrix.
  virtual void add_damping(const double* damping, ConstReals x, double scale, BlockMatrix& matrix) const = 0;

 protected:
  ~DampedSprings() = default;
};

class BodyModel : public ForceModel {
 public:
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }

  [[nodiscard]] virtual const ElasticBlock& block() const = 0;
  [[nodiscard]] virtual std::int32_t cell_count() const = 0;
  [[nodiscard]] virtual int nodes_per_cell() const = 0;
  [[nodiscard]] virtual const std::vector<double>& volumes() const = 0;  ///< at rest [m3]
  /// Adds each node's lumped mass [kg]: sum_g w_g rho N_a for elements of first order; for the others the
  /// mass of the cell in proportion to the integral of N_a^2 (Hinton, Rock and Zienkiewicz 1976), which is
  /// never negative.
  virtual void add_masses(std::vector<double>& nodal) const = 0;
  /// Adds each node's share of a body force, sum_g w_g rho N_a [kg]: consistent, and negative at some corners
  /// of quadratic elements.
  virtual void add_weights(std::vector<double>& nodal) const = 0;
  /// Adds what it gives to the inertia of each frame about its origin, in its own axes [kg m2].
  virtual void add_inertias(std::vector<Mat3>& /*of_frames*/) const {}
  /// Adds each frame's share of the moment of a body force, sum_s w_s m_s l_s [kg m], in its own axes.
  virtual void add_moments(std::vector<Vec3>& /*of_frames*/) const {}
  /// Nodes that are not unknowns: the model knows where they are from the others. None may belong to other
  /// models, be held, or carry a load.
  [[nodiscard]] virtual std::span<const std::int32_t> eliminated() const { return {}; }
  /// Puts those nodes where they are.
  virtual void settle(State& /*state*/) const {}
  [[nodiscard]] virtual CellFields fields(const State& state) const = 0;
  /// The least of its cells' mean det F, infinite where it has none. Models whose cells are not judged at
  /// points of their own take no memory for it.
  [[nodiscard]] virtual double least_volume_ratio(const State& state, Scratch& scratch) const;
  /// Where its integration points are [m], three numbers each, where they are not those of cells.
  [[nodiscard]] virtual std::vector<double> points(const State& /*state*/) const { return {}; }
  /// Its springs, beside which its viscosity stands; null: it stands in the cells.
  [[nodiscard]] virtual const DampedSprings* springs() const { return nullptr; }
  /// F, P and W at its integration points; of models without a stress no points.
  [[nodiscard]] virtual PointFields point_fields(const PointQuery& query) const;
  /// What it holds of its cells, node and matrix places included.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// Numbers kept of each cell's rest shape and law; those that all cells share are kept once.
  [[nodiscard]] virtual std::size_t reals_per_cell() const = 0;

  /// What edits its cells in place; null: it is made anew after an edit.
  [[nodiscard]] virtual std::unique_ptr<CellEditor> make_editor();
  /// Itself without some of its cells, their numbers in its block ascending; `left` is the block of the
  /// others. Null: it has nothing to take over, and is made anew.
  [[nodiscard]] virtual std::unique_ptr<BodyModel> without(
      const ElasticBlock& /*left*/, const std::vector<std::int32_t>& /*removed*/) const {
    return nullptr;
  }
};

/// The model among these, a body's before an edit, that carried all cells of `left`, without its other cells;
/// null when there is none, or when it is to be made anew.
std::unique_ptr<BodyModel> edited_model(const std::vector<const BodyModel*>& before,
                                        const ElasticBlock& left);

}  // namespace tissu
