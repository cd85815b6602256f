#include "capacitance.h"

#include <Eigen/Eigenvalues>

namespace tissu {
namespace {

constexpr double kZero = 1e-14;  ///< of the largest eigenvalue of H: round-off

}  // namespace

bool Capacitance::lay_rows(const Couplings& couplings, Eigen::Index size) {
  const std::vector<Coupling>& list = couplings.list();
  if (list.size() > static_cast<std::size_t>(kMostRows)) return false;
  G_.setZero(size, kMostRows);
  Eigen::Index count = 0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(list[c].H);
    const double least = kZero * eigen.eigenvalues()[2];
    for (int k = 0; k < 3; ++k) {
      if (!(eigen.eigenvalues()[k] > least)) continue;
      if (count == kMostRows) return false;
      const Vec3 g = std::sqrt(eigen.eigenvalues()[k]) * eigen.eigenvectors().col(k);
      for (const Couplings::Term& term : couplings.terms(c)) {
        G_.col(count).segment<3>(3 * static_cast<Eigen::Index>(term.row)) += term.B.transpose() * g;
      }
      ++count;
    }
  }
  G_.conservativeResize(size, count);
  return true;
}

bool Capacitance::make(SparseFactor& factor, const BlockMatrix& A) {
  id_ = 0;
  if (!lay_rows(*A.couplings(), 3 * static_cast<Eigen::Index>(A.rows()))) return false;
  W_.resize(G_.rows(), G_.cols());
  const auto size = static_cast<std::size_t>(G_.size());
  if (size > 0) factor.solve_all(static_cast<int>(G_.cols()), {G_.data(), size}, {W_.data(), size});
  Eigen::MatrixXd S = G_.transpose() * W_;
  S = (0.5 * (S + S.transpose())).eval();
  S.diagonal().array() += 1.0;
  factor_.compute(S);
  if (factor_.info() != Eigen::Success) return false;
  id_ = A.id();
  version_ = A.version();
  return true;
}

void Capacitance::solve(SparseFactor& factor, ConstReals b, Reals x) {
  factor.solve(b, x);
  Eigen::Map<Eigen::VectorXd> y(x.data(), static_cast<Eigen::Index>(x.size()));
  shares_.noalias() = G_.transpose() * y;
  factor_.solveInPlace(shares_);
  y.noalias() -= W_ * shares_;
}

std::size_t Capacitance::bytes() const {
  return static_cast<std::size_t>(G_.size() + W_.size()) * sizeof(double);
}

}  // namespace tissu
