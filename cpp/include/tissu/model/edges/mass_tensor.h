#pragma once

/// Mass-tensor, as published: the energy of linear tetrahedra as a polynomial of degree four in the
/// displacements, whose constants stand on the nodes, edges, faces and tetrahedra of the mesh
/// (tensor_constants.h), and nothing of the rest shape beside them. A tetrahedron alone has 280 on its nodes,
/// edges and faces, as Picinbono counts them, and 6 of its own; in a mesh it shares them with its neighbours.
///
/// The sums cancel where displacements are large against strains, so round-off grows with the cube of the
/// displacement over the size of a cell; displacements are counted from that of one node, so that a
/// translation costs no digits, but a turn does. A removed cell changes the constants of its own parts only.
///
/// A definite matrix is that of continuum elements, which have the same energy: what stands on a node, an
/// edge or a face is indefinite at rest too, and no cell's. They are made when the first is asked for.

#include <memory>
#include <mutex>
#include <vector>

#include "tissu/model/cell_model.h"
#include "tissu/model/edges/mass_tensor_kernels.h"
#include "tissu/model/edges/tensor_table.h"
#include "tissu/model/model_info.h"
#include "tissu/model/part_energies.h"

namespace tissu {

class MassTensor final : public CellModel, public PartEnergies {
 public:
  static ModelInfo info();
  /// `block` has a law and an element of info(), as make_model sees to. Refuses parameters out of range and
  /// cells that are inverted or have no volume.
  MassTensor(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "elasticity"; }
  [[nodiscard]] bool has_constant_stiffness() const override { return linear_; }
  void bind(const Sparsity& pattern) override;
  void add_masses(std::vector<double>& nodal) const override;
  void add_weights(std::vector<double>& nodal) const override;
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
  /// Of a tetrahedron alone, as published; `bytes` has what a mesh holds.
  [[nodiscard]] std::size_t reals_per_cell() const override;
  [[nodiscard]] std::unique_ptr<BodyModel> without(const ElasticBlock& left,
                                                   const std::vector<std::int32_t>& removed) const override;

  /// Constants that it holds, …
  [[nodiscard]] std::size_t constants() const;
  /// … and those of them that were summed up when it was made; an edit takes over the others.
  [[nodiscard]] std::size_t computed_constants() const;

 private:
  struct Part {
    const MassTensorKernels* kernels;
    TensorTable table;
  };
  MassTensor(const MassTensor& before, ElasticBlock left, const std::vector<std::int32_t>& removed);
  void lay_laws();
  [[nodiscard]] TensorCell cell(std::int32_t number) const;
  [[nodiscard]] const Lame& lame_of(std::int32_t cell) const;
  [[nodiscard]] Loops<MassTensorKernels, MassTensorView> loops(const Part& part) const;

  /// Continuum elements with the same energy, bound to a pattern.
  [[nodiscard]] const BodyModel& elements(const Sparsity& pattern) const;

  Isa isa_;
  bool linear_;
  std::vector<double> X_;   ///< positions at rest of the whole world
  std::vector<Lame> lame_;  ///< of all cells, or of each
  std::vector<Part> parts_;
  // A cache: made by the first call that asks for a definite matrix, under the lock, and only read after
  // that.
  mutable std::mutex making_elements_;
  mutable std::unique_ptr<BodyModel> elements_;  ///< of StVK
};

}  // namespace tissu
