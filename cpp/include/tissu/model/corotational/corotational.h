#pragma once

/// Corotational linear elasticity: Hooke's law in axes that turn with each cell. Equations:
/// src/model/corotational/kernels/corotational.h.
///
/// One rotation for a cell, of F at its centre, not one for each quadrature point: a hexahedron needs one in
/// place of eight, K is the one of linear elasticity, and a crushed cell has one rest shape to go back to.
///
/// `polar`: f = -dW/dx with all of R's part, so that energy, momentum and its moment are kept, whatever the
/// tangent. `frame` with the approximate tangent is the classical f = -R K (R^T x - X), whose moments are not
/// in balance; with the exact tangent it is -dW/dx, which a squeezed frame makes stiff and rough.
///
/// `tangent` approximate: R K R^T, which has no negative eigenvalue in any state; cells come back from
/// inversion with it. exact: the derivative of the force, for Newton's method near a solution; indefinite
/// where cells are far from rest.

#include <vector>

#include "tissu/model/cell_model.h"
#include "tissu/model/corotational/corotational_kernels.h"
#include "tissu/model/model_info.h"
#include "tissu/model/part_energies.h"

namespace tissu {

class Corotational final : public CellModel, public PartEnergies {
 public:
  static ModelInfo info();
  /// Refuses elements, laws, quadratures, rotations and tangents that it does not have, parameters out of
  /// range and cells that are inverted or have no volume at rest.
  Corotational(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "elasticity"; }
  [[nodiscard]] bool has_constant_stiffness() const override { return rotation_ == Rotation::small; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;
  void add_part_energies(const State& state, Scratch& scratch, std::span<const std::int32_t> part_of,
                         Reals energies) const override;

  [[nodiscard]] CellFields fields(const State& state) const override;
  [[nodiscard]] PointFields point_fields(const PointQuery& query) const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;

 private:
  void choose_kernels(Isa isa, bool one_jacobian, bool exact_tangent);
  void lay_centres(ConstReals rest_positions);
  [[nodiscard]] Loops<CorotationalKernels, CorotationalView> loops(const CorotationalKernels& kernels) const;

  Rotation rotation_ = Rotation::polar;
  const CorotationalKernels* forces_ = nullptr;
  const CorotationalKernels* tangents_ = nullptr;
  AlignedVector<double> centres_;  ///< [group][6][8], empty where one J serves the cell
};

}  // namespace tissu
