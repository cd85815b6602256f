#include "eigenvalues.h"

#include <Eigen/Eigenvalues>

namespace tissu::test {

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& D) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, D, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::MatrixXd clamped(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(symmetric);
  return of.eigenvectors() * of.eigenvalues().cwiseMax(0.0).asDiagonal() * of.eigenvectors().transpose();
}

}  // namespace tissu::test
