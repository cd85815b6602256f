#pragma once

/// What makes sparse factors: one struct of the same members for each library.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "lower_triangle.h"
#include "sparse_factor.h"
#include "tissu/base/error.h"

#ifdef TISSU_HAVE_CHOLMOD
#include <cholmod.h>
// One thread in the dense kernels of the factor: sums in one order, so that the bits do not depend on the
// machine.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
#else
#include <Eigen/SparseCholesky>
#endif

namespace tissu {

struct FactorState {
  LowerTriangle lower;
  std::uint64_t id = 0;
  std::uint64_t version = 0;
  bool definite = false;
  bool ready = false;
};

#ifdef TISSU_HAVE_CHOLMOD

struct SparseFactor::Library : FactorState {
  static constexpr std::string_view kName = "CHOLMOD";
  /// Dense kernels on supernodes: measured by bench/solvers.py.
  static constexpr double kOperationsPerByte = 0.5;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* y = nullptr;
  cholmod_dense* e = nullptr;
  cholmod_dense* solution = nullptr;
  double operations = 0.0;
  double numbers = 0.0;

  Library() {
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder = 1;
    common.supernodal = CHOLMOD_AUTO;
    common.final_ll = 1;
    common.print = 0;
    common.quick_return_if_not_posdef = 1;
  }
  ~Library() {
    for (auto** dense : {&y, &e, &solution}) cholmod_free_dense(dense, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  cholmod_sparse view() {
    cholmod_sparse A{};
    A.nrow = lower.column_begin.size() - 1;
    A.ncol = A.nrow;
    A.nzmax = lower.row.size();
    A.p = lower.column_begin.data();
    A.i = lower.row.data();
    A.x = lower.values.data();
    A.stype = -1;
    A.itype = CHOLMOD_INT;
    A.xtype = CHOLMOD_REAL;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = 1;
    A.packed = 1;
    return A;
  }
  void analyse() {
    cholmod_free_factor(&factor, &common);
    cholmod_sparse A = view();
    factor = cholmod_analyze(&A, &common);
    if (factor == nullptr)
      throw Error("CHOLMOD could not order the matrix: it is out of memory; use conjugate_gradient.");
    operations = 0.5 * common.fl;
    numbers = common.lnz;
  }
  bool factorise() {
    cholmod_sparse A = view();
    cholmod_factorize(&A, factor, &common);
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) {
      throw Error("the Cholesky factor does not fit into memory; use the solver conjugate_gradient.");
    }
    return common.status == CHOLMOD_OK && factor->minor == factor->n;
  }
  void solve(ConstReals b, Reals x) {
    cholmod_dense right{};
    right.nrow = b.size();
    right.ncol = 1;
    right.nzmax = b.size();
    right.d = b.size();
    right.x = const_cast<double*>(
        b.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast): CHOLMOD only reads it
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor, &right, nullptr, &solution, nullptr, &y, &e, &common);
    std::copy_n(static_cast<const double*>(solution->x), x.size(), x.begin());
  }
  [[nodiscard]] std::size_t bytes() const { return common.memory_inuse; }
};

#else

struct SparseFactor::Library : FactorState {
  static constexpr std::string_view kName = "Eigen";
  /// One number after the other.
  static constexpr double kOperationsPerByte = 0.05;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> llt;
  double operations = 0.0;
  double numbers = 0.0;
  std::vector<double> diagonal;  ///< of A, in the order of the factor

  Eigen::Map<const Eigen::SparseMatrix<double>> view() const {
    const auto n = static_cast<Eigen::Index>(lower.column_begin.size()) - 1;
    return {n,
            n,
            static_cast<Eigen::Index>(lower.row.size()),
            lower.column_begin.data(),
            lower.row.data(),
            lower.values.data()};
  }
  void analyse() {
    llt.analyzePattern(view());
    operations = 0.0;
  }
  bool factorise() {
    llt.factorize(view());
    if (llt.info() != Eigen::Success || is_singular()) return false;
    if (operations == 0.0) {
      const auto& L = llt.matrixL().nestedExpression();
      numbers = static_cast<double>(L.nonZeros());
      for (Eigen::Index c = 0; c < L.outerSize(); ++c) {
        const auto count = static_cast<double>(L.outerIndexPtr()[c + 1] - L.outerIndexPtr()[c]);
        operations += 0.5 * count * count;
      }
    }
    return true;
  }
  /// A pivot is what is left of A_cc = sum_k L_ck^2; round-off alone leaves no digit of it.
  bool is_singular() {
    constexpr double kLost = 64.0 * std::numeric_limits<double>::epsilon();
    const auto& L = llt.matrixL().nestedExpression();
    diagonal.assign(static_cast<std::size_t>(L.cols()), 0.0);
    for (Eigen::Index c = 0; c < L.outerSize(); ++c) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(L, c); entry; ++entry)
        diagonal[static_cast<std::size_t>(entry.row())] += entry.value() * entry.value();
    }
    for (Eigen::Index c = 0; c < L.outerSize(); ++c) {
      const Eigen::SparseMatrix<double>::InnerIterator pivot(L, c);  // the first entry of its column
      if (!(pivot.value() * pivot.value() > kLost * diagonal[static_cast<std::size_t>(c)])) return true;
    }
    return false;
  }
  void solve(ConstReals b, Reals x) {
    Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())) =
        llt.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size())));
  }
  [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(12.0 * numbers); }
};

#endif

}  // namespace tissu
