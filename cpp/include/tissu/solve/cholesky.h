#pragma once

#include <memory>
#include <vector>

#include "tissu/solve/linear_solver.h"

namespace tissu {

class CoupledSolve;
class SparseFactor;

/// Direct solve by a Cholesky factor: CHOLMOD (supernodal, nested dissection), or Eigen's simplicial factor
/// in a build without it. The symbolic part is kept while the pattern is, the factor while the values are. A
/// matrix that is not positive definite gets a growing share of its diagonal added until it is, and the
/// report says so. An answer whose residual is large is refined, and one that stays wrong, as that of a
/// singular matrix, is reported as not converged. Couplings beside the matrix leave its factor as it is.
class Cholesky final : public LinearSolver {
 public:
  Cholesky();
  ~Cholesky() override;
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::string_view preparation() const override { return "factor"; }
  SolveReport solve(const LinearOperator& A, ConstReals b, Reals x, double floor) override;
  void forget() override;
  [[nodiscard]] std::size_t bytes() const override;

 private:
  /// Lowers the residual of x by further solves, and returns it.
  template <class Solve>
  void refine(const BlockMatrix& matrix, ConstReals b, Reals x, double floor, bool definite,
              SolveReport& report, Solve&& solve);

  std::unique_ptr<SparseFactor> factor_;
  std::unique_ptr<CoupledSolve> coupled_;  ///< from the first couplings on
  std::vector<double> residual_;
  std::vector<double> correction_;
};

}  // namespace tissu
