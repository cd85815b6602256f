#pragma once

/// Dense systems of equations: Eigen's factor, compiled once for all tests.

#include "tissu/base/vec.h"

namespace tissu::test {

/// X of A X = B for a symmetric A, of which only the lower triangle is read: by LDL^T.
Eigen::MatrixXd dense_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace tissu::test
