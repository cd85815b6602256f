#pragma once

/// The Cholesky factor of a block matrix, made by CHOLMOD, or by Eigen in a build without it.

#include <memory>
#include <string_view>

#include "tissu/assembly/block_matrix.h"

namespace tissu {

class SparseFactor {
 public:
  SparseFactor();
  ~SparseFactor();
  SparseFactor(const SparseFactor&) = delete;
  SparseFactor& operator=(const SparseFactor&) = delete;

  static std::string_view library();

  /// Factors the matrix, with its symbolic part kept while the pattern is. A matrix that is not positive
  /// definite gets a growing share of its diagonal added until it is. Throws what refuse_factor throws when
  /// none is large enough. `coupled`: of the matrix and its couplings; else of the matrix alone.
  void make(const BlockMatrix& matrix, bool coupled = false);
  /// Factors the matrix alone as it is; false, and nothing is kept, where it is not positive definite.
  bool attempt(const BlockMatrix& matrix);
  /// It belongs to the values that the matrix has now.
  [[nodiscard]] bool is_of(const BlockMatrix& matrix, bool coupled = false) const;
  /// The matrix was positive definite as it was.
  [[nodiscard]] bool is_definite() const;
  /// x = A^-1 b, with the matrix that the factor was made of.
  void solve(ConstReals b, Reals x);
  /// The same for several b and x, one after the other.
  void solve_all(int columns, ConstReals b, Reals x);
  void forget();

  /// Operations of a making, a multiplication with its addition counted as one.
  [[nodiscard]] double operations() const;
  /// Work (work.h) of making a factor of so many operations, numbers, and rows of three.
  [[nodiscard]] static double making_work(double operations, double numbers, double rows);
  /// Bytes of the factor's numbers: what half a solve reads.
  [[nodiscard]] double number_bytes() const;
  /// Work (work.h) of the latest making, of its ordering where the pattern was new, and of a solve.
  [[nodiscard]] double making() const { return making_; }
  [[nodiscard]] double once() const { return once_; }
  [[nodiscard]] double application() const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Library;
  /// Takes over the pattern, and begins the count of a making.
  void take_pattern(const BlockMatrix& matrix, const Couplings* couplings);
  bool factorise();

  std::unique_ptr<Library> library_;
  double making_ = 0.0;
  double once_ = 0.0;
};

}  // namespace tissu
