#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tissu/solve/linear_solver.h"

namespace tissu {

class Ahead;
class Choice;
enum class Arm : unsigned char;

/// Solves each system by the cheapest way that it knows: conjugate gradient with block-Jacobi, incomplete
/// Cholesky, a multigrid or the factor of an earlier matrix, or a factor of the matrix itself. Which one is
/// decided by counted work (SolveReport), predicted from the matrix at first and then learned as the solves
/// go on (solve/choice.h); never by a clock, so that the same calls give the same bits on any number of
/// threads.
///
/// A way that spends more than another one would have taken is left within a solve, whose x the other one
/// goes on from. So is one that fails; the last resort is a factor, where its memory is affordable. A matrix
/// that is not positive definite is reported at once, as by every solver.
class Automatic final : public LinearSolver {
 public:
  struct Settings {
    double tolerance = 1e-6;
    bool equilibrium = false;  ///< without inertia: few solves share a preconditioner
  };
  explicit Automatic(Settings settings);
  ~Automatic() override;
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::string_view preparation() const override { return "preparation"; }
  [[nodiscard]] bool needs_places() const override { return true; }
  /// Which ways solved how many systems, and how often they changed.
  [[nodiscard]] std::string account() const override;
  SolveReport solve(const LinearOperator& A, ConstReals b, Reals x, double floor) override;
  bool prepare_ahead(const LinearOperator& A) override;
  void forget() override;
  [[nodiscard]] std::size_t bytes() const override;

 private:
  /// What it knows of matrices follows, and what it expects of each way.
  void meet(const BlockMatrix& A);
  /// The same where something was made ahead, which is forgotten if it does not serve.
  void meet_after(const LinearOperator& A);
  void predict(bool first);
  LinearSolver& solver(Arm arm);
  SolveReport attempt(const LinearOperator& A, ConstReals b, Reals x, double floor, double left);
  /// What is not used any more.
  void drop();

  Settings settings_;
  std::unique_ptr<Choice> choice_;
  struct Known;
  std::unique_ptr<Known> known_;  ///< of the matrix
  std::unique_ptr<Ahead> ahead_;
  std::vector<std::unique_ptr<LinearSolver>> solvers_;
  std::vector<std::int64_t> solves_;  ///< of each way
  int changes_ = 0;                   ///< of those that were forgotten
};

}  // namespace tissu
