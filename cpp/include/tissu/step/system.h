#pragma once

/// Forces and matrix of a world, timed: what every integrator asks for.

#include <memory>
#include <optional>
#include <vector>

#include "tissu/assembly/block_matrix.h"
#include "tissu/assembly/row_places.h"
#include "tissu/base/profile.h"
#include "tissu/contact/implicit_contact.h"
#include "tissu/solve/linear_solver.h"
#include "tissu/step/free_operator.h"
#include "tissu/world/world.h"

namespace tissu {

class System {
 public:
  /// `solver` may be null where no system is solved.
  System(const World& world, LinearSolver* solver, Profile& profile);

  [[nodiscard]] const World& world() const { return world_; }
  /// Follows an edit of the world in place, after which some rows of the pattern have other columns.
  void follow_edit(std::span<const std::int32_t> rows);
  /// Scratch of the models, for calls to them beside the verbs below.
  [[nodiscard]] Scratch& scratch() { return scratch_; }
  /// f = all forces
  void force(const State& state, Reals f);
  /// The norm of the forces from outside the bodies on free rows, which go into f. Where there are none it is
  /// zero, and f is left as it was.
  double external_force(const State& state, Reals f);
  /// out += (scale.position df/dx + scale.velocity df/dv) p
  void add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out);
  /// A = mass M + scale.position df/dx + scale.velocity df/dv, given degrees of freedom as the identity.
  /// Nothing is done when a linear world is asked for the matrix it has; couplings are always made anew. For
  /// a solver that needs no matrix, A is a product only, at a copy of the state.
  void assemble(const State& state, double mass, StiffnessScale scale);
  /// What is coupled beside A becomes that of this state. Only after `assemble`.
  void recouple(const State& state);
  /// The mean of -df/dx and of its definite matrix, of which it takes that share, and `mass` M. A solver that
  /// asks for products only gets the definite matrix.
  void assemble_mean(const State& state, double share, double mass = 0.0);
  /// The contact of a world that touches in implicit steps, or in static ones.
  std::unique_ptr<ImplicitContact> make_contact(bool is_static);
  std::unique_ptr<ImplicitContact> make_contact(bool is_static, ContactMethod method);
  /// The solver makes what it needs of the matrix before there is a step. Only after `assemble`.
  void prepare_ahead();
  /// Solves A x = b from the first guess x.
  SolveReport solve(ConstReals b, Reals x, double floor);

  /// What round-off alone can leave in A x: epsilon |diag(A) x|.
  [[nodiscard]] double round_off(const State& state) const;

  /// What was assembled, or is multiplied with. Only after `assemble`.
  [[nodiscard]] const LinearOperator& system_matrix() const;
  /// The blocks, of a solver that needs them. Only after `assemble`.
  [[nodiscard]] const BlockMatrix& matrix() const;

 private:
  struct Rows {
    std::size_t force;
    std::size_t product;
    std::size_t stiffness;
  };
  /// What is coupled now, beside the matrix.
  void couple(const State& state, StiffnessScale scale, BlockMatrix& matrix);
  /// Where the rows are, for a solver that asks.
  void place_rows(const State& state);
  void assemble_blocks(const State& state, double mass, StiffnessScale scale, double definite = 0.0);

  const World& world_;
  LinearSolver* solver_;
  Profile& profile_;
  std::optional<BlockMatrix> matrix_;  ///< one of the two, made when it is first asked for
  std::optional<FreeOperator> free_;
  Couplings couplings_;
  Scratch scratch_;
  RowPlaces places_;  ///< empty unless the solver asks for them
  std::vector<Rows> rows_;
  std::size_t mass_row_;
  std::size_t preparation_row_ = 0;
  std::size_t solve_row_ = 0;
  bool assembled_ = false;
  bool is_constant_;  ///< the matrix itself is the same for every state, whatever is coupled beside it
  double mass_scale_ = 0.0;
  StiffnessScale scale_;
};

}  // namespace tissu
