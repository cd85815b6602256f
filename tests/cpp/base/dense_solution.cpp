#include "dense_solution.h"

#include <Eigen/Cholesky>

namespace tissu::test {

Eigen::MatrixXd dense_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.ldlt().solve(B);
}

}  // namespace tissu::test
