#pragma once

/// Solves with A + C from the factor of A, where C couples few rows. With C = G^T G, a row of G for each
/// eigenvalue above zero of each H, and W = A^-1 G^T,
///
///     (A + C)^-1 b = y - W (I + G W)^-1 G y,   y = A^-1 b
///
/// (Hager, Updating the inverse of a matrix, SIAM Review 31, 1989). I + G W is the capacitance matrix.
///
/// A step solves many systems with one A and couplings that change, between the same few rows. The columns of
/// A^-1 of those rows give W of any couplings between them. They are solved for once, from the second system
/// on, unless they are far more than the columns of W.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "sparse_factor.h"

namespace tissu {

class Capacitance {
 public:
  static constexpr std::int32_t kMostRows = 48;    ///< of G
  static constexpr std::size_t kMostSolved = 128;  ///< rows of A whose columns of A^-1 are kept, or …
  static constexpr std::size_t kFewSolved = 16;  ///< … as many as fill the room of the factor; at least these

  /// From the factor of A alone; false where C has more than kMostRows rows.
  bool make(SparseFactor& factor, const BlockMatrix& A);
  [[nodiscard]] bool is_of(const BlockMatrix& A) const { return id_ == A.id() && version_ == A.version(); }
  /// x = (A + C)^-1 b
  void solve(SparseFactor& factor, ConstReals b, Reals x);
  void forget();
  /// Work (work.h) of the latest making, and what a solve adds to that with the factor.
  [[nodiscard]] double making() const { return making_; }
  [[nodiscard]] double application() const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  bool lay_rows(const Couplings& couplings);
  void take_matrix(const BlockMatrix& A);
  [[nodiscard]] std::size_t list_missing();
  void solve_rows(SparseFactor& factor);
  void solve_couplings(SparseFactor& factor);
  void lay_inverse();
  [[nodiscard]] Eigen::Index place(std::int32_t row) const;

  std::uint64_t id_ = 0;
  std::uint64_t version_ = 0;
  std::uint64_t matrix_id_ = 0;  ///< A that the columns of A^-1 are of, …
  std::uint64_t values_version_ = 0;
  Eigen::Index size_ = 0;  ///< … and its unknowns
  double making_ = 0.0;
  Eigen::Index spent_ = 0;             ///< columns of W solved for with that A, and not kept
  bool of_rows_ = false;               ///< W comes from columns of A^-1
  std::vector<std::int32_t> touched_;  ///< rows of A that C couples, ascending
  Eigen::MatrixXd G_;                  ///< of those rows: three columns each
  std::vector<std::int32_t> solved_;   ///< rows of A whose columns of A^-1 are kept, in their order
  std::vector<double> inverse_;        ///< those columns, three of each row
  std::vector<std::int32_t> missing_;
  std::vector<double> right_;  ///< right-hand sides
  std::vector<double> W_;      ///< where it does not come from those columns
  Eigen::MatrixXd K_;          ///< A^-1 of the touched rows
  Eigen::MatrixXd S_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd y_;
  Eigen::VectorXd shares_;
};

}  // namespace tissu
