#pragma once

#include <vector>

#include "tissu/solve/linear_solver.h"

namespace tissu {

/// Conjugate gradient, preconditioned with the inverses of the diagonal 3x3 blocks (block-Jacobi). Stops at
/// |b - A x| <= tolerance |b|, and at the first direction p with p . A p <= 0: such a matrix is not positive
/// definite, and the report says so.
class ConjugateGradient final : public LinearSolver {
 public:
  struct Settings {
    double tolerance = 1e-6;
    int iterations = 1000;
  };
  explicit ConjugateGradient(Settings settings);
  [[nodiscard]] std::string_view name() const override { return "conjugate gradient, block-Jacobi"; }
  SolveReport solve(const BlockMatrix& matrix, ConstReals b, Reals x, double floor) override;

 private:
  void resize(std::size_t size);
  void invert_diagonal(const BlockMatrix& matrix);
  /// z = D^-1 r, and returns r . z; |r|^2 goes into `square`.
  double precondition(const Threads& threads, double& square);

  Settings settings_;
  std::vector<double> inverse_;  ///< [row][9], column by column
  std::vector<double> r_;
  std::vector<double> z_;
  std::vector<double> p_;
  std::vector<double> q_;
  std::vector<double> partial_;
  std::vector<double> partial_square_;
};

}  // namespace tissu
