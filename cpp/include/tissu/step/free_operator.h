#pragma once

#include <vector>

#include "tissu/assembly/linear_operator.h"
#include "tissu/world/world.h"

namespace tissu {

/// The matrix of a step as a product only: A p = mass M p + (scale.position df/dx + scale.velocity df/dv) p
/// from the models' own products, given degrees of freedom as the identity. It keeps a copy of the state.
///
/// The diagonal blocks are exact: rows get colours so that two of one colour are not coupled, and the product
/// with ones in one axis of all rows of a colour gives their columns of the diagonal. Couplings of the
/// running world stand beside it as beside an assembled matrix.
class FreeOperator final : public LinearOperator {
 public:
  explicit FreeOperator(const World& world);
  /// A at this state, from now on. `scale.definite` is of matrices only.
  void set(const State& state, double mass, StiffnessScale scale);
  /// What is coupled at this state, beside what `set` found.
  void couple(const State& state);

  [[nodiscard]] std::int32_t rows() const override { return world_.blocks(); }
  [[nodiscard]] const Threads& threads() const override { return threads_; }
  void multiply(ConstReals p, Reals out) const override;
  void diagonal_blocks(Reals blocks) const override;
  [[nodiscard]] double diagonal_cost() const override { return 3.0 * colours(); }
  /// From the diagonal asked for last; made when there is none.
  [[nodiscard]] double round_off(ConstReals x) const override;
  [[nodiscard]] std::size_t bytes() const override;

 private:
  [[nodiscard]] int colours() const;
  void color() const;
  void multiply_models(ConstReals p, Reals out) const;

  const World& world_;
  Threads threads_;
  State state_;
  double mass_ = 0.0;
  StiffnessScale scale_;
  Couplings couplings_;
  // Work of the one step that it belongs to.
  mutable std::vector<double> free_;  ///< p without the given numbers; where there are any
  mutable std::vector<double> unit_;
  mutable std::vector<double> column_;
  mutable std::vector<double> diagonal_;  ///< three numbers for each row
  mutable std::vector<std::int32_t> color_;
  mutable int colours_ = 0;
  mutable Scratch scratch_;
};

}  // namespace tissu
