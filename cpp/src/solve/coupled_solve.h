#pragma once

/// What Cholesky does with couplings C beside the matrix A, whose factor it keeps:
///   few rows of couplings: their capacitance matrix (capacitance.h);
///   more: the conjugate gradient on A + C with the factor of A as its preconditioner;
///   where that takes too long, or A alone is not positive definite: a factor of A + C.

#include <chrono>
#include <memory>
#include <vector>

#include "capacitance.h"
#include "sparse_factor.h"
#include "tissu/solve/linear_solver.h"

namespace tissu {

class CoupledSolve {
 public:
  /// Solves (A + C) x = b once; `of_matrix` is or becomes the factor of A.
  void solve(const BlockMatrix& A, SparseFactor& of_matrix, ConstReals b, Reals x, SolveReport& report);
  /// Another solve with the same matrix, as the latest was done: a correction.
  void again(SparseFactor& of_matrix, ConstReals b, Reals x);
  /// The factor that it took last was of a positive definite matrix.
  [[nodiscard]] bool is_definite() const { return definite_; }
  void forget();
  [[nodiscard]] std::size_t bytes() const;

 private:
  enum class Way { capacitance, gradient, whole };
  bool has_factor(const BlockMatrix& A, SparseFactor& of_matrix, SolveReport& report);
  static void count_preparation(std::chrono::steady_clock::time_point begin, const SparseFactor& made,
                                SolveReport& report);
  bool iterate(const BlockMatrix& A, SparseFactor& of_matrix, ConstReals b, Reals x);
  void take_whole(const BlockMatrix& A, SolveReport& report);

  Way way_ = Way::capacitance;
  bool definite_ = true;
  const BlockMatrix* matrix_ = nullptr;
  Capacitance capacitance_;
  std::unique_ptr<SparseFactor> whole_;     ///< of A + C
  std::vector<Couplings::Key> whole_keys_;  ///< couplings for which it is taken at once
  std::vector<Couplings::Key> keys_;
  int left_ = 0;  ///< iterations that the latest gradient had left
  std::vector<double> r_;
  std::vector<double> z_;
  std::vector<double> p_;
  std::vector<double> q_;
};

}  // namespace tissu
