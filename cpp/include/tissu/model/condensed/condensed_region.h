#pragma once

/// A linear region whose inner nodes are eliminated (static condensation; Bro-Nielsen and Cotin 1996).
///
/// With k the nodes that are kept and i those that are eliminated,
///   S = K_kk - K_ki K_ii^-1 K_ik [N/m],   u_i = K_ii^-1 (weight_i - K_ik u_k),
/// and what kept nodes feel of the weight of the others, -K_ki K_ii^-1 weight_i; all computed once.

#include <Eigen/Core>
#include <memory>
#include <mutex>

#include "tissu/model/fem/elastic.h"
#include "tissu/solve/cholesky.h"

namespace tissu {

class CondensedRegion {
 public:
  /// Refuses what Elastic refuses, and regions whose inner nodes the kept ones do not hold.
  CondensedRegion(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads);

  [[nodiscard]] const Elastic& elastic() const { return elastic_; }
  [[nodiscard]] const std::vector<double>& rest() const { return rest_; }          ///< of the whole world [m]
  [[nodiscard]] const std::vector<std::int32_t>& kept() const { return kept_; }    ///< ascending
  [[nodiscard]] const std::vector<std::int32_t>& inner() const { return inner_; }  ///< ascending
  [[nodiscard]] const Eigen::MatrixXd& stiffness() const { return S_; }
  /// Of gravity, less what it does to the masses of the kept nodes [N]
  [[nodiscard]] const Eigen::VectorXd& pull() const { return pull_; }
  /// weight_i . K_ii^-1 weight_i: the way that the weight of the inner nodes goes where the kept ones stand
  /// [J]
  [[nodiscard]] double sag() const { return sag_; }
  /// Sum of weights times places at rest, less that of the masses of the kept nodes [J]
  [[nodiscard]] double pull_at_rest() const { return pull_at_rest_; }
  /// Of the kept nodes [kg]: those of the inner ones are shared in proportion to their own, for slow motion.
  [[nodiscard]] const std::vector<double>& masses() const { return masses_; }
  /// Puts inner nodes where they are, with the velocities that the kept ones give them.
  void settle(State& state) const;

 private:
  void sort_nodes();
  void assemble(Isa isa);
  void condense();
  void share_masses();
  /// x_inner = K_ii^-1 b_inner in arrays of the whole world.
  void solve_inner(Reals b, Reals x) const;

  Elastic elastic_;
  std::vector<double> rest_;
  std::vector<std::int32_t> kept_;
  std::vector<std::int32_t> inner_;
  Eigen::MatrixXd S_;
  Eigen::VectorXd pull_;
  double sag_ = 0.0;
  double pull_at_rest_ = 0.0;
  std::vector<double> masses_;
  std::vector<double> weight_;        ///< of the inner nodes, in an array of the whole world [N]
  Sparsity pattern_;                  ///< of the region
  std::unique_ptr<BlockMatrix> K_;    ///< of the region, inner rows included
  std::unique_ptr<BlockMatrix> Kii_;  ///< the same with kept nodes as given
  std::vector<std::uint8_t> given_;
  // A cache: the factor of Kii_, made once, and the room that a solve with it works in; one caller at a time.
  mutable std::mutex looking_;
  mutable Cholesky factor_;
  mutable std::vector<double> room_;  ///< of settle
};

}  // namespace tissu
