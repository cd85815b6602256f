#pragma once

/// Mass-link (HEML, "masse-liaison étendue"): a tetrahedron as six links that know of each other.
///
/// The energy is written in the squared lengths l_e^2 of the edges, never in F. For St-Venant–Kirchhoff,
///   W = V dL^T MW dL,  dL = l^2 - l0^2,  MW_ef = lambda/8 tr(C_e) tr(C_f) + mu/4 tr(C_e C_f)   [J]
/// with 21 numbers of 4 V MW and 6 of l0^2 kept of each tetrahedron; for neo-Hooke,
///   W = V (mu/2 (I_C - 3) - mu/2 ln det C + lambda/8 (ln det C)^2),
/// where I_C = sum_e tr(C_e) l_e^2 and det C = J^2 is a cubic in the l_e^2: 9 numbers. J itself is found as a
/// volume, because lengths do not tell a tetrahedron from its mirror image.
/// An edge e = (a, b) pulls with its tension t_e = 2 dW/d(l_e^2) [N/m]:  f_a = t_e (x_b - x_a) = -f_b.
///
/// Chendeb 2007, section 3.3, with the corrections of eq. 3.46 to 3.67 (E is linear in dL, so W has no linear
/// term, and the force is minus the gradient); Goulette and Chendeb 2006. Neo-Hooke as Bonet and Wood
/// 2008, 6.28.

#include "tissu/model/cell_model.h"
#include "tissu/model/edges/mass_link_kernels.h"
#include "tissu/model/model_info.h"
#include "tissu/model/part_energies.h"

namespace tissu {

class MassLink final : public CellModel, public PartEnergies {
 public:
  static ModelInfo info();
  /// `block` has a law and an element of info(), as make_model sees to. Refuses parameters out of range and
  /// cells that are inverted or have no volume.
  MassLink(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "elasticity"; }
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
  void lay_links(ConstReals rest_positions);
  [[nodiscard]] Loops<MassLinkKernels, MassLinkView> loops() const;

  const MassLinkKernels* kernels_ = nullptr;
};

}  // namespace tissu
