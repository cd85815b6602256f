#pragma once

#include <vector>

#include "aggregates.h"
#include "block_rows.h"

namespace tissu {

/// Smooths with a matrix: a Chebyshev polynomial of D^-1 A for the upper part of its eigenvalues (Adams,
/// Brezina, Hu and Tuminaro, Parallel multigrid smoothing: polynomial versus Gauss-Seidel, J. Comput. Phys.
/// 188, 2003). It is symmetric, and its sums do not depend on an order of rows. A product and what follows
/// from it in the same rows are one pass: three passes from zero, two from an x.
template <class T>
class Chebyshev {
 public:
  /// Takes over the values, which live in the pattern of A; the couplings outlive it. `measured`: the largest
  /// eigenvalue too, which else stays: smoothing bears one that is 15 % larger, and a preconditioner that
  /// does not serve is made as a whole.
  void make(const LevelMatrix& A, Isa isa, const Threads& threads, bool measured = true);
  /// Measures the largest eigenvalue of the matrix that it was made of.
  void find_largest(const Threads& threads);
  /// x from zero; afterwards `residual()` = b - A x.
  void smooth_from_zero(const Threads& threads, const T* b, T* x);
  /// x from what it is.
  void smooth(const Threads& threads, const T* b, T* x);
  [[nodiscard]] const T* residual() const { return r_.data(); }
  [[nodiscard]] const T* inverse() const { return inverse_.data(); }
  /// Of D^-1 A, by Lanczos' method: at least its largest Ritz value and what that may be off by.
  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] std::int32_t rows() const { return A_.rows(); }
  [[nodiscard]] std::size_t bytes() const;
  /// Bytes that smoothing twice reads.
  [[nodiscard]] double cycle_bytes() const;

 private:
  /// Rows [begin, end) of A p, where couplings were gathered.
  void multiply_rows(std::int32_t begin, std::int32_t end, const T* p, T* out) const;
  void gather(const Threads& threads, const T* p) const;
  /// Of two steps: d = first D^-1 r, then own d + share D^-1 r.
  struct Polynomial {
    T first;
    T own;
    T share;
  };
  [[nodiscard]] Polynomial polynomial() const;
  void second_step(std::int32_t begin, std::int32_t end, const T* r, T* to);

  BlockRows<T> A_;
  const Couplings* couplings_ = nullptr;
  double coupling_scale_ = 1.0;
  std::vector<T> inverse_;  ///< D^-1, [row][9]
  std::vector<T> r_;
  std::vector<T> d_;
  std::vector<T> q_;
  std::vector<double> partial_;
  double largest_ = 0.0;
};

}  // namespace tissu
