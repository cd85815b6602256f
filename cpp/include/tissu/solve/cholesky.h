#pragma once

#include <memory>

#include "tissu/solve/linear_solver.h"

namespace tissu {

/// Direct solve by a Cholesky factor: CHOLMOD (supernodal, nested dissection), or Eigen's simplicial factor
/// in a build without it. The symbolic part is kept while the pattern is, the factor while the values are. A
/// matrix that is not positive definite gets a growing share of its diagonal added until it is, and the
/// report says so.
class Cholesky final : public LinearSolver {
 public:
  Cholesky();
  ~Cholesky() override;
  [[nodiscard]] std::string_view name() const override;
  SolveReport solve(const BlockMatrix& matrix, ConstReals b, Reals x, double floor) override;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace tissu
