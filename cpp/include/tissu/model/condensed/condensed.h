#pragma once

/// A condensed region as a model: f_k = -S u_k + pull_k (see condensed_region.h). A step knows the kept nodes
/// only; where the others are is found when somebody looks. Beside a region with another model this is the
/// hybrid of Cotin, Delingette and Ayache (2000): their common nodes are kept, and that region may change its
/// topology without anything being condensed again.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tissu/model/condensed/condensed_region.h"
#include "tissu/model/model_info.h"
#include "tissu/model/part_energies.h"

namespace tissu {

class Condensed final : public BodyModel, public PartEnergies {
 public:
  static ModelInfo info();
  /// `CondensedOptions::kept` holds the nodes that are kept; the others must belong to no other block, be
  /// held by nothing and carry no load.
  Condensed(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "condensed elasticity"; }
  [[nodiscard]] bool has_constant_stiffness() const override { return true; }
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;
  void add_part_energies(const State& state, Scratch& scratch, std::span<const std::int32_t> part_of,
                         Reals energies) const override;
  /// Of the weight of all nodes, less that of the kept ones' masses, which the world's gravity has.
  [[nodiscard]] double potential(const State& state) const override;

  [[nodiscard]] const ElasticBlock& block() const override { return block_; }
  [[nodiscard]] std::int32_t cell_count() const override { return region_->elastic().cell_count(); }
  [[nodiscard]] int nodes_per_cell() const override { return region_->elastic().nodes_per_cell(); }
  [[nodiscard]] const std::vector<double>& volumes() const override { return region_->elastic().volumes(); }
  void add_masses(std::vector<double>& nodal) const override;
  void add_weights(std::vector<double>& nodal) const override { add_masses(nodal); }
  [[nodiscard]] CellFields fields(const State& state) const override {
    return region_->elastic().fields(state);
  }
  [[nodiscard]] PointFields point_fields(const PointQuery& query) const override {
    return region_->elastic().point_fields(query);
  }
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;
  [[nodiscard]] std::span<const std::int32_t> eliminated() const override { return region_->inner(); }
  void settle(State& state) const override { region_->settle(state); }
  /// The same region where no cell of its own goes.
  [[nodiscard]] std::unique_ptr<BodyModel> without(const ElasticBlock& left,
                                                   const std::vector<std::int32_t>& removed) const override;

 private:
  Condensed(std::shared_ptr<const CondensedRegion> region, ElasticBlock block)
      : region_(std::move(region)), block_(std::move(block)) {}
  [[nodiscard]] Eigen::VectorXd displacements(const State& state) const;
  template <class Value>
  void multiply(double scale, Value&& p, Reals f) const;

  std::shared_ptr<const CondensedRegion> region_;
  ElasticBlock block_;
  std::vector<std::int32_t> slots_;  ///< [row][column], blocks of the matrix
};

}  // namespace tissu
