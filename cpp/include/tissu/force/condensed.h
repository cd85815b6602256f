#pragma once

/// A linear region whose inner nodes are eliminated (static condensation; Bro-Nielsen and Cotin 1996).
///
/// With k the nodes that are kept and i those that are eliminated,
///   S = K_kk - K_ki K_ii^-1 K_ik [N/m],   f_k = -S u_k + K_ki K_ii^-1 (…) of the weight of the inner nodes,
/// computed once. A step knows the kept nodes only; where the others are is found when somebody looks:
///   u_i = K_ii^-1 (weight_i - K_ik u_k).
/// Beside a region with another model this is the hybrid of Cotin, Delingette and Ayache (2000): their common
/// nodes are kept, and that region may change its topology.

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <span>

#include "tissu/force/elastic.h"
#include "tissu/solve/cholesky.h"

namespace tissu {

class Condensed final : public BodyModel {
 public:
  static ModelInfo info();
  /// `block.model.kept` holds the nodes that are kept; the others must belong to no other block, be held by
  /// nothing and carry no load. Refuses what Elastic refuses, and regions whose inner nodes nothing holds.
  Condensed(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] std::string_view effect() const override { return "condensed elasticity"; }
  [[nodiscard]] bool has_constant_stiffness() const override { return true; }
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Reals f) const override;
  void add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const override;
  void add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const override;
  [[nodiscard]] double energy(const State& state) const override;

  [[nodiscard]] const ElasticBlock& block() const override { return elastic_.block(); }
  [[nodiscard]] std::int32_t cell_count() const override { return elastic_.cell_count(); }
  [[nodiscard]] int nodes_per_cell() const override { return elastic_.nodes_per_cell(); }
  [[nodiscard]] const std::vector<double>& volumes() const override { return elastic_.volumes(); }
  /// Those of the inner nodes go to the kept ones, in proportion to their own: slow motion only.
  void add_masses(std::vector<double>& nodal) const override;
  void add_weights(std::vector<double>& nodal) const override { add_masses(nodal); }
  [[nodiscard]] CellFields fields(const State& state) const override { return elastic_.fields(state); }
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;

  [[nodiscard]] std::span<const std::int32_t> eliminated() const override { return inner_; }
  void settle(State& state) const override;

 private:
  void sort_nodes();
  void assemble(ConstReals rest_positions, Isa isa);
  void condense();
  void share_masses();
  /// x_inner = K_ii^-1 b_inner in arrays of the whole world.
  void solve_inner(Reals b, Reals x) const;
  template <class Value>
  void multiply(double scale, Value&& p, Reals f) const;
  [[nodiscard]] Eigen::VectorXd displacements(const State& state) const;

  Elastic elastic_;
  std::vector<double> rest_;          ///< of the whole world [m]
  std::vector<std::int32_t> kept_;    ///< nodes of the world, ascending
  std::vector<std::int32_t> inner_;   ///< those that are eliminated, ascending
  Eigen::MatrixXd S_;                 ///< [N/m]
  Eigen::VectorXd pull_;              ///< of gravity, less that of the masses of the kept nodes [N]
  std::vector<double> masses_;        ///< of the kept nodes [kg]
  std::vector<double> weight_;        ///< of the inner nodes, in an array of the whole world [N]
  std::vector<std::int32_t> slots_;   ///< [row][column], blocks of the matrix
  Sparsity pattern_;                  ///< of the region
  std::unique_ptr<BlockMatrix> K_;    ///< of the region, inner rows included
  std::unique_ptr<BlockMatrix> Kii_;  ///< the same with kept nodes as given
  std::vector<std::uint8_t> given_;
  mutable std::mutex looking_;  ///< the factor's scratch is shared by all who look at inner nodes
  mutable Cholesky factor_;
};

}  // namespace tissu
