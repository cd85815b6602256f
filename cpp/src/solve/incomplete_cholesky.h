#pragma once

#include "block_triangle.h"
#include "kernels/sweep_list.h"
#include "preconditioner.h"

namespace tissu {

/// Incomplete Cholesky factor of 3x3 blocks without fill: (D + S) D^-1 (D + S)^T has the blocks of A wherever
/// A has any.
///
///   S_ij = A_ij - sum_k S_ik D_k^-1 S_jk^T,   D_i = A_ii - sum_k S_ik D_k^-1 S_ik^T
///
/// Of couplings beside the matrix it takes those blocks that the pattern has room for; the others are
/// dropped.
///
/// Where a D_i comes out that is not positive definite, all starts again with a share of the diagonal added
/// to A (Manteuffel, An incomplete factorization technique for positive definite linear systems, Math. Comp.
/// 34, 1980), tenfold each time.
template <class T>
class IncompleteCholesky final : public Preconditioner<T> {
 public:
  void make(const LinearOperator& A, double scale) override;
  [[nodiscard]] double price() const override { return price_; }
  [[nodiscard]] double making() const override { return making_; }
  [[nodiscard]] double application() const override;
  void apply(std::span<const T> r, std::span<T> z) override;
  void forget() override { shift_ = 0.0; }
  [[nodiscard]] std::size_t bytes() const override;

 private:
  bool factor(const BlockMatrix& A, double scale);
  template <bool kCoupled>
  bool factor_row(const BlockMatrix& A, double scale, std::int32_t i);
  void gather_couplings(const BlockMatrix& A);
  [[nodiscard]] Mat3 diagonal(const BlockMatrix& A, std::int32_t i) const;
  /// What couplings add to a block below the diagonal.
  [[nodiscard]] Mat3 coupled(std::int64_t b) const;
  void drop_blocks(const BlockMatrix& A, double scale);
  void scale_rows();

  /// A coupling's share of a block of the triangle; those of a block stand in the order of the list.
  struct Share {
    std::int64_t block;
    std::size_t order;
    Mat3 value;
  };

  BlockTriangle triangle_;
  std::vector<Share> shares_;
  Threads threads_;
  SweepRows<T> sweep_ = nullptr;
  double shift_ = 0.0;
  double price_ = 0.0;
  double making_ = 0.0;
  AlignedVector<T> lower_;    ///< S, then D^-1 S
  AlignedVector<T> upper_;    ///< S D^-1 while it is made, then D^-1 S^T
  std::vector<T> inverse_;    ///< D^-1, [row][9]
  std::vector<char> failed_;  ///< rows whose D is not positive definite
};

}  // namespace tissu
