#pragma once

#include <string>
#include <string_view>

#include "tissu/assembly/block_matrix.h"
#include "tissu/assembly/linear_operator.h"

namespace tissu {

struct SolveReport {
  int iterations = 0;             ///< 1 for a direct solve
  double residual = 0.0;          ///< |b - A x| / |b|
  bool converged = false;         ///< the residual, computed from x, is within the tolerance
  bool positive_definite = true;  ///< false: x is a descent direction of the problem, not its solution
  int preparations = 0;           ///< how often a preconditioner or a factor was made
  double preparation_seconds = 0.0;
  double work = 0.0;    ///< in bytes read from memory, or what takes as long; counted, never timed
  double making = 0.0;  ///< the share of it that went into preconditioners or factors, …
  double once = 0.0;    ///< … and the share of what a new pattern asked for: an ordering, aggregates
};

/// Solves A x = b with a symmetric matrix that is meant to be positive definite. Nothing that it decides
/// depends on time measured: the same calls give the same bits.
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// What it makes of a matrix before it solves, as profiles name it.
  [[nodiscard]] virtual std::string_view preparation() const = 0;
  /// It reads the blocks; false: products are enough.
  [[nodiscard]] virtual bool needs_matrix() const { return true; }
  /// It asks where the rows of the matrix are.
  [[nodiscard]] virtual bool needs_places() const { return false; }
  /// x holds the first guess and then the answer. A right-hand side below `floor` counts as `floor` when the
  /// residual is judged, so that a body at rest is not solved to the last bit of its round-off.
  virtual SolveReport solve(const LinearOperator& A, ConstReals b, Reals x, double floor) = 0;
  /// Makes what its first solve will ask of this matrix: ordering, aggregates, preconditioner. That solve
  /// takes it if its matrix is the same to the last bit, and else makes its own, so that it gives the bits
  /// that it gives without. Only before the first solve. False: it made nothing.
  virtual bool prepare_ahead(const LinearOperator& /*A*/) { return false; }
  /// Drops what it keeps of earlier matrices: the next solve gives the bits that a new solver gives.
  virtual void forget() = 0;
  /// What it chose in the solves so far, and by which counts; empty for a solver that has one way.
  [[nodiscard]] virtual std::string account() const { return {}; }
  /// What it keeps, the matrix itself not counted.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// Residual to which x is accepted where round-off does not let it fall to `tolerance`: what round-off alone
/// leaves in A x, but never more than `kWorst`, so that an x that ran off is not taken for an answer.
double attainable(const LinearOperator& A, ConstReals x, double reference, double tolerance);

}  // namespace tissu
