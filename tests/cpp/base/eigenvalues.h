#pragma once

/// The eigenvalues of symmetric matrices of any size: Eigen's solver, compiled once for all tests.

#include "tissu/base/vec.h"

namespace tissu::test {

/// Ascending. Only the lower triangle is read.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);
/// Those of A x = lambda D x, D positive definite. Ascending. Only the lower triangles are read.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& D);

/// The nearest positive semi-definite matrix: negative eigenvalues give way to zero.
Eigen::MatrixXd clamped(const Eigen::MatrixXd& symmetric);

}  // namespace tissu::test
