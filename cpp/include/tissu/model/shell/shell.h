#pragma once

/// Thin walls that bend: triangles of shell_element.h on nodes that have rotations. The block's
/// `cross_section` is the thickness, its `frames` say which rotation belongs to which node.

#include <vector>

#include "tissu/model/cell_model.h"
#include "tissu/model/model_info.h"
#include "tissu/model/shell/shell_element.h"

namespace tissu {

class Shell final : public CellModel {
 public:
  static ModelInfo info();
  /// Refuses quadratures but full, plane strain, nodes without frames or with several, parameters out of
  /// range and cells without an area.
  Shell(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "shell"; }
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  /// `scale.definite`: the part that the elements' K makes, without that of the stress.
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

  void add_inertias(std::vector<Mat3>& of_frames) const override;
  /// Von Mises' stress is that of the face where it is larger.
  [[nodiscard]] CellFields fields(const State& state) const override;
  [[nodiscard]] double least_volume_ratio(const State& state, Scratch& scratch) const override;
  [[nodiscard]] PointFields point_fields(const PointQuery& query) const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;

 private:
  void lay_unknowns();
  void lay_elements(ConstReals rest_positions);
  [[nodiscard]] ShellPose pose(const State& state, std::size_t cell) const;
  /// Adds the numbers of a cell to those of its nodes and their rotations.
  void scatter(const Vec18& values, std::size_t cell, Reals to) const;
  /// Calls f(lane number, cell, element) for every cell; those that run at the same time share no node.
  template <class Function>
  void for_cells(Function&& f) const;

  std::vector<std::int32_t> unknowns_;  ///< six blocks for each cell: of a node, of its rotation, …
  std::vector<ShellElement> elements_;  ///< of each lane
};

}  // namespace tissu
