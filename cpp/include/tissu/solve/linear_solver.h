#pragma once

#include <string_view>

#include "tissu/assembly/block_matrix.h"

namespace tissu {

struct SolveReport {
  int iterations = 0;             ///< 1 for a direct solve
  double residual = 0.0;          ///< |b - A x| / |b|
  bool converged = false;         ///< the residual is within the tolerance
  bool positive_definite = true;  ///< false: x is a descent direction of the problem, not its solution
};

/// Solves A x = b with a symmetric matrix that is meant to be positive definite.
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// x holds the first guess and then the answer. A right-hand side below `floor` counts as `floor` when the
  /// residual is judged, so that a body at rest is not solved to the last bit of its round-off.
  virtual SolveReport solve(const BlockMatrix& matrix, ConstReals b, Reals x, double floor) = 0;
  /// Drops what is kept of earlier solves, so that the next one answers as the first would.
  virtual void forget() {}
};

}  // namespace tissu
