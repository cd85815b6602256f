#pragma once

/// Continuum elements: the elasticity of one block of like cells, an element, a quadrature and a law.

#include <vector>

#include "tissu/cell/elastic_kernels.h"
#include "tissu/model/cell_model.h"
#include "tissu/model/model_info.h"
#include "tissu/model/part_energies.h"

namespace tissu {

class Elastic final : public CellModel, public PartEnergies {
 public:
  static ModelInfo info();
  /// Refuses unknown names, parameters out of range and cells that are inverted or have no volume.
  Elastic(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "elasticity"; }
  [[nodiscard]] bool has_constant_stiffness() const override;
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
  [[nodiscard]] std::unique_ptr<CellEditor> make_editor() override;
  void add_energies(const Chunk& chunk, ConstReals x, Reals lanes) const override;

 private:
  void choose_kernels(Isa isa);
  [[nodiscard]] Loops<ElasticKernels, ElasticView> loops() const;

  const ElasticKernels* kernels_ = nullptr;
  std::vector<const LawKernels*> laws_;
  std::vector<double> gradients_;  ///< [point][node][m]
  Isa isa_;
  std::vector<double> X_;  ///< of sheets and lines: positions at rest of the whole world, for their fields
};

}  // namespace tissu
