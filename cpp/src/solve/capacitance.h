#pragma once

/// Solves with A + C from the factor of A, where C couples few rows. With C = G^T G, a row of G for each
/// eigenvalue above zero of each H, and W = A^-1 G^T,
///
///     (A + C)^-1 b = y - W (I + G W)^-1 G y,   y = A^-1 b
///
/// (Hager, Updating the inverse of a matrix, SIAM Review 31, 1989). I + G W is the capacitance matrix.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "sparse_factor.h"

namespace tissu {

class Capacitance {
 public:
  static constexpr std::int32_t kMostRows = 48;

  /// From the factor of A alone; false where C has more than kMostRows rows.
  bool make(SparseFactor& factor, const BlockMatrix& A);
  [[nodiscard]] bool is_of(const BlockMatrix& A) const { return id_ == A.id() && version_ == A.version(); }
  /// x = (A + C)^-1 b
  void solve(SparseFactor& factor, ConstReals b, Reals x);
  void forget() { id_ = 0; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  bool lay_rows(const Couplings& couplings, Eigen::Index size);

  std::uint64_t id_ = 0;
  std::uint64_t version_ = 0;
  Eigen::MatrixXd G_;  ///< its transpose: a column for each row of G
  Eigen::MatrixXd W_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd shares_;
};

}  // namespace tissu
