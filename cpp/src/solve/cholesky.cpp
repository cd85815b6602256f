#include "tissu/solve/cholesky.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lower_triangle.h"
#include "tissu/base/error.h"
#include "tissu/base/norm.h"

#ifdef TISSU_HAVE_CHOLMOD
#include <cholmod.h>
// One thread in the dense kernels of the factor: sums in one order, so that the bits do not depend on the
// machine.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
#else
#include <Eigen/SparseCholesky>
#endif

namespace tissu {
namespace {

constexpr double kFirstShift = 1e-4;
constexpr double kLastShift = 1e6;

}  // namespace

#ifdef TISSU_HAVE_CHOLMOD

struct Cholesky::Factor {
  static constexpr std::string_view kName = "Cholesky (CHOLMOD)";
  LowerTriangle lower;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* y = nullptr;
  cholmod_dense* e = nullptr;
  cholmod_dense* solution = nullptr;

  Factor() {
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
  ~Factor() {
    for (auto** dense : {&y, &e, &solution}) cholmod_free_dense(dense, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

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

  std::uint64_t version = 0;
  bool definite = false;
  bool ready = false;
  std::vector<double> residual;
};

#else

struct Cholesky::Factor {
  static constexpr std::string_view kName = "Cholesky (Eigen)";
  LowerTriangle lower;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> llt;

  Eigen::Map<const Eigen::SparseMatrix<double>> view() const {
    const auto n = static_cast<Eigen::Index>(lower.column_begin.size()) - 1;
    return {n,
            n,
            static_cast<Eigen::Index>(lower.row.size()),
            lower.column_begin.data(),
            lower.row.data(),
            lower.values.data()};
  }
  void analyse() { llt.analyzePattern(view()); }
  bool factorise() {
    llt.factorize(view());
    return llt.info() == Eigen::Success;
  }
  void solve(ConstReals b, Reals x) {
    Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())) =
        llt.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size())));
  }

  std::uint64_t version = 0;
  bool definite = false;
  bool ready = false;
  std::vector<double> residual;
};

#endif

Cholesky::Cholesky() : factor_(std::make_unique<Factor>()) {}
Cholesky::~Cholesky() = default;
std::string_view Cholesky::name() const { return Factor::kName; }

SolveReport Cholesky::solve(const BlockMatrix& matrix, ConstReals b, Reals x, double floor) {
  Factor& f = *factor_;
  const bool new_pattern = f.lower.update_pattern(matrix);
  if (new_pattern) f.analyse();
  if (new_pattern || !f.ready || f.version != matrix.version()) {
    double shift = 0.0;
    f.lower.update_values(matrix, shift);
    while (!f.factorise()) {
      shift = shift == 0.0 ? kFirstShift : 10.0 * shift;
      if (shift > kLastShift) throw Error("the matrix of the step is not finite or has a zero diagonal.");
      f.lower.update_values(matrix, shift);
    }
    f.definite = shift == 0.0;
    f.ready = true;
    f.version = matrix.version();
  }
  f.solve(b, x);

  SolveReport report;
  report.iterations = 1;
  report.positive_definite = f.definite;
  f.residual.resize(b.size());
  matrix.multiply(x, f.residual);
  for (std::size_t i = 0; i < b.size(); ++i) f.residual[i] -= b[i];
  const double reference = std::max(norm(b), floor);
  report.residual = reference > 0.0 ? norm(f.residual) / reference : 0.0;
  report.converged = f.definite && std::isfinite(report.residual);
  return report;
}

}  // namespace tissu
