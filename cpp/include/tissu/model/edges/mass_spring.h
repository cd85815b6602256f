#pragma once

/// Masses and springs on the edges of tetrahedra, as chendeb2007 (2.3) has them:
///
///     k = E sum_e V_e / l0^2   (Van Gelder 1998, extended to volumes)     m_i = rho sum_e V_e / 4
///
/// the sums over the tetrahedra of an edge and of a node; E Young's modulus [Pa], l0 the edge at rest [m].
/// A spring pulls with k (l - l0) along itself.
///
/// Poisson's ratio is not a parameter, and the law gives Young's modulus only. Where edges lie in all
/// directions alike the rule makes a material with Lamé's constants lambda = mu = 2 E / 5: Young's modulus E
/// and Poisson's ratio 1/4; a mesh with directions of its own is not isotropic and departs from both. Nothing
/// resists a cell that is turned inside out.

#include "tissu/model/cell_model.h"
#include "tissu/model/edges/spring_kernels.h"
#include "tissu/model/model_info.h"
#include "tissu/model/part_energies.h"

namespace tissu {

class MassSpring final : public CellModel, public DampedSprings, public PartEnergies {
 public:
  static ModelInfo info();
  /// `MassSpringOptions::equal_masses`: the block's mass in equal parts on its nodes, whatever volume they
  /// have around them.
  MassSpring(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "springs"; }
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;
  void add_part_energies(const State& state, Scratch& scratch, std::span<const std::int32_t> part_of,
                         Reals energies) const override;

  void add_masses(std::vector<double>& nodal) const override;
  void add_weights(std::vector<double>& nodal) const override { add_masses(nodal); }
  /// Von Mises' stress is not known; a cell's energy is what its own part of each spring holds.
  [[nodiscard]] CellFields fields(const State& state) const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;

  [[nodiscard]] std::int32_t spring_count() const;

  [[nodiscard]] const DampedSprings* springs() const override { return this; }
  [[nodiscard]] const AlignedVector<double>& shares() const override { return shares_; }
  void add_damping(const double* damping, ConstReals x, double scale, ConstReals p, Reals out) const override;
  void add_damping(const double* damping, ConstReals x, double scale, BlockMatrix& matrix) const override;

 private:
  void lay_springs(ConstReals rest_positions);
  [[nodiscard]] double young(std::size_t cell) const;
  [[nodiscard]] Loops<SpringKernels, SpringView> loops(const double* damping = nullptr) const;

  const SpringKernels* kernels_;
  std::vector<double> rest_;        ///< of the cells' nodes: what fields are measured from
  std::vector<std::int32_t> ends_;  ///< two nodes of each spring
  ElementOrder springs_;
  AlignedVector<std::int32_t> spring_slots_;
  AlignedVector<double> stiffness_;
  AlignedVector<double> length_;
  AlignedVector<double> shares_;
};

}  // namespace tissu
