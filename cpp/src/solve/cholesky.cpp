#include "tissu/solve/cholesky.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "coupled_solve.h"
#include "sparse_factor.h"
#include "tissu/base/error.h"
#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr double kWorst = 1e-6;     ///< residual of an answer that is accepted
constexpr double kRefined = 1e-10;  ///< an answer above it is refined
constexpr int kMostRefinements = 5;

}  // namespace

Cholesky::Cholesky() : factor_(std::make_unique<SparseFactor>()) {}
Cholesky::~Cholesky() = default;

std::string_view Cholesky::name() const {
  return SparseFactor::library() == "CHOLMOD" ? "Cholesky (CHOLMOD)" : "Cholesky (Eigen)";
}

void Cholesky::forget() {
  factor_->forget();
  if (coupled_ != nullptr) coupled_->forget();
}

std::size_t Cholesky::bytes() const {
  return factor_->bytes() + (coupled_ == nullptr ? 0 : coupled_->bytes()) +
         (residual_.size() + correction_.size()) * sizeof(double);
}

template <class Solve>
void Cholesky::refine(const BlockMatrix& matrix, ConstReals b, Reals x, double floor, bool definite,
                      SolveReport& report, Solve&& solve) {
  const double reference = std::max(norm(b), floor);
  double size = 0.0;
  const auto find_residual = [&] {
    matrix.multiply(x, residual_);
    report.work += static_cast<double>(matrix.bytes());
    for (std::size_t i = 0; i < b.size(); ++i) residual_[i] = b[i] - residual_[i];
    size = norm(residual_);
  };
  find_residual();
  for (int i = 0; i < kMostRefinements && definite && size > kRefined * reference; ++i) {
    const double before = size;
    solve(ConstReals(residual_), Reals(correction_));
    report.work += factor_->application();
    for (std::size_t k = 0; k < b.size(); ++k) x[k] += correction_[k];
    find_residual();
    if (!(size < 0.5 * before)) {
      if (!(size < before)) {
        for (std::size_t k = 0; k < b.size(); ++k) x[k] -= correction_[k];
        size = before;
      }
      break;
    }
  }
  report.positive_definite = definite;
  report.residual = reference > 0.0 ? size / reference : 0.0;
  report.converged = report.positive_definite && report.residual <= kWorst;
}

SolveReport Cholesky::solve(const LinearOperator& A, ConstReals b, Reals x, double floor) {
  if (A.matrix() == nullptr) throw ParameterError("Cholesky needs an assembled matrix.");
  const BlockMatrix& matrix = *A.matrix();
  SolveReport report;
  residual_.resize(b.size());
  correction_.resize(b.size());
  report.iterations = 1;
  if (A.couplings() != nullptr) {
    if (coupled_ == nullptr) coupled_ = std::make_unique<CoupledSolve>();
    coupled_->solve(matrix, *factor_, b, x, report);
    report.work += report.iterations * (factor_->application() + static_cast<double>(A.bytes()));
    refine(matrix, b, x, floor, coupled_->is_definite(), report,
           [&](ConstReals r, Reals change) { coupled_->again(*factor_, r, change); });
    return report;
  }
  if (!factor_->is_of(matrix)) {
    const auto begin = std::chrono::steady_clock::now();
    factor_->make(matrix);
    report.preparations = 1;
    report.making = factor_->making();
    report.once = factor_->once();
    report.work = report.making + report.once;
    report.preparation_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  factor_->solve(b, x);
  report.work += factor_->application();
  refine(matrix, b, x, floor, factor_->is_definite(), report,
         [&](ConstReals r, Reals change) { factor_->solve(r, change); });
  return report;
}

}  // namespace tissu
