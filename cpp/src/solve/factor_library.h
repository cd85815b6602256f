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
// CHOLMOD asks OpenMP for four threads in each supernode, however few the processors are; what they wait for
// each other takes as long as the factor itself.
extern "C" int omp_get_max_active_levels(void) __attribute__((weak));
extern "C" void omp_set_max_active_levels(int) __attribute__((weak));
#else
#include <Eigen/SparseCholesky>
#endif

namespace tissu {

/// A pivot is what is left of the diagonal A_cc = sum_k L_ck^2; round-off alone leaves no digit of it. What
/// is not a number is not lost: the step that finds it says so.
inline bool is_lost(double pivot, double diagonal) {
  return pivot <= 64.0 * std::numeric_limits<double>::epsilon() * diagonal;
}

struct FactorState {
  LowerTriangle lower;
  /// Rows of three.
  [[nodiscard]] double rows() const { return (static_cast<double>(lower.column_begin.size()) - 1.0) / 3.0; }
  std::uint64_t id = 0;
  std::uint64_t version = 0;
  bool definite = false;
  bool ready = false;
};

#ifdef TISSU_HAVE_CHOLMOD

/// OpenMP makes no threads while this lives. Where the setting is one for all threads of the process (libgomp
/// before GCC 12) and another thread has switched them off, that one switches them on again.
class WithoutThreads {
 public:
  WithoutThreads() {
    if (before_ > 0) omp_set_max_active_levels(0);
  }
  ~WithoutThreads() {
    if (before_ > 0) omp_set_max_active_levels(before_);
  }
  WithoutThreads(const WithoutThreads&) = delete;
  WithoutThreads& operator=(const WithoutThreads&) = delete;

 private:
  static bool is_there() {
    return omp_get_max_active_levels != nullptr && omp_set_max_active_levels != nullptr;
  }
  int before_ = is_there() ? omp_get_max_active_levels() : 0;
};

struct SparseFactor::Library : FactorState {
  static constexpr std::string_view kName = "CHOLMOD";
  /// Operations of a making that take the time of reading one byte: dense kernels on supernodes. This and the
  /// weights of numbers and rows are a fit to factors of 80 to 3,400 rows, of lines, sheets and cubes: each
  /// is met to 17 %.
  static constexpr double kOperationsPerByte = 0.9;
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
    const WithoutThreads alone;
    cholmod_factorize(&A, factor, &common);
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) {
      throw Error("the Cholesky factor does not fit into memory; use the solver conjugate_gradient.");
    }
    return common.status == CHOLMOD_OK && factor->minor == factor->n && !is_singular();
  }
  /// The number on the diagonal of the factor's column.
  [[nodiscard]] double pivot(std::size_t column, std::size_t& supernode) const {
    const auto* x = static_cast<const double*>(factor->x);
    if (factor->is_super == 0) return x[static_cast<const int*>(factor->p)[column]];
    const auto* first = static_cast<const int*>(factor->super);
    while (static_cast<std::size_t>(first[supernode + 1]) <= column) ++supernode;
    const auto* rows = static_cast<const int*>(factor->pi);
    const auto within = static_cast<std::ptrdiff_t>(column) - first[supernode];
    const std::ptrdiff_t height = rows[supernode + 1] - rows[supernode];
    return x[static_cast<const int*>(factor->px)[supernode] + within * (height + 1)];
  }
  [[nodiscard]] bool is_singular() const {
    const auto* order = static_cast<const int*>(factor->Perm);
    std::size_t supernode = 0;
    for (std::size_t c = 0; c < factor->n; ++c) {
      const double left = pivot(c, supernode);
      const auto from = static_cast<std::size_t>(lower.column_begin[static_cast<std::size_t>(order[c])]);
      if (is_lost(left * left, lower.values[from])) return true;  // the diagonal begins its column
    }
    return false;
  }
  void solve(int columns, ConstReals b, Reals x) {
    cholmod_dense right{};
    right.nrow = b.size() / static_cast<std::size_t>(columns);
    right.ncol = static_cast<std::size_t>(columns);
    right.nzmax = b.size();
    right.d = right.nrow;
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
  bool is_singular() {
    const auto& L = llt.matrixL().nestedExpression();
    diagonal.assign(static_cast<std::size_t>(L.cols()), 0.0);
    for (Eigen::Index c = 0; c < L.outerSize(); ++c) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(L, c); entry; ++entry)
        diagonal[static_cast<std::size_t>(entry.row())] += entry.value() * entry.value();
    }
    for (Eigen::Index c = 0; c < L.outerSize(); ++c) {
      const Eigen::SparseMatrix<double>::InnerIterator pivot(L, c);  // the first entry of its column
      if (is_lost(pivot.value() * pivot.value(), diagonal[static_cast<std::size_t>(c)])) return true;
    }
    return false;
  }
  void solve(int columns, ConstReals b, Reals x) {
    const auto rows = static_cast<Eigen::Index>(b.size()) / columns;
    for (Eigen::Index c = 0; c < columns; ++c) {
      Eigen::Map<Eigen::VectorXd>(x.data() + c * rows, rows) =
          llt.solve(Eigen::Map<const Eigen::VectorXd>(b.data() + c * rows, rows));
    }
  }
  [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(12.0 * numbers); }
};

#endif

}  // namespace tissu
