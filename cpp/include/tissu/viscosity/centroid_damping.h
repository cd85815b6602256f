#pragma once

/// The viscosity of chendeb2007 (3.6.2): each node of a cell is damped against the velocity of the cell's
/// centroid, in proportion to the cell's volume at rest,
///
///     f_a = -c V (v_a - sum_b v_b / n)
///
/// c [N s/m4], V [m3], n nodes. It is a damper c V / n between every two nodes of a cell, so the force is
/// linear in v, keeps momentum and leaves a translation alone; a rotation it damps, which Kelvin–Voigt does
/// not.

#include <vector>

#include "tissu/base/parallel.h"
#include "tissu/model/body_model.h"

namespace tissu {

class CentroidDamping final : public ForceModel {
 public:
  /// Of the cells of one body's models, of any kind.
  CentroidDamping(const std::vector<const BodyModel*>& models, double coefficient, Threads threads);
  [[nodiscard]] std::string_view effect() const override { return "centroid viscosity"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }
  [[nodiscard]] bool has_constant_stiffness() const override { return true; }
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;

 private:
  struct Cells {
    std::vector<std::int32_t> nodes;  ///< of the body, from its first on
    int size;
  };
  /// Calls f(row, column, entry of own_) for the entries of some rows.
  template <class Function>
  void for_entries(std::int32_t begin, std::int32_t end, Function&& f) const;

  Threads threads_;
  std::vector<Cells> cells_;
  std::int32_t first_node_ = 0;
  Sparsity own_;                     ///< which nodes share a cell
  std::vector<double> dampers_;      ///< of each entry of own_ [N s/m]; none on the diagonal
  std::vector<std::int32_t> slots_;  ///< of each entry of own_, in the matrix
};

}  // namespace tissu
