#include "coupled_solve.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr int kMostIterations = 60;
constexpr double kReached = 1e-10;  ///< of the right-hand side

double product(ConstReals a, ConstReals b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

}  // namespace

void CoupledSolve::solve(const BlockMatrix& A, SparseFactor& of_matrix, ConstReals b, Reals x,
                         SolveReport& report) {
  matrix_ = &A;
  A.couplings()->keys(keys_);
  const bool at_once = !whole_keys_.empty() && keys_ == whole_keys_;
  if (!at_once && has_factor(A, of_matrix, report)) {
    definite_ = true;
    const bool is_made = capacitance_.is_of(A);
    if (is_made || capacitance_.make(of_matrix, A)) {
      way_ = Way::capacitance;
      capacitance_.solve(of_matrix, b, x);
      report.work += capacitance_.application() + (is_made ? 0.0 : capacitance_.making());
      return;
    }
    way_ = Way::gradient;
    if (iterate(A, of_matrix, b, x)) {
      report.iterations = kMostIterations - left_;
      return;
    }
  }
  take_whole(A, report);
  whole_->solve(b, x);
}

bool CoupledSolve::has_factor(const BlockMatrix& A, SparseFactor& of_matrix, SolveReport& report) {
  if (of_matrix.is_of(A)) return of_matrix.is_definite();
  const auto begin = std::chrono::steady_clock::now();
  const bool made = of_matrix.attempt(A);
  count_preparation(begin, of_matrix, report);
  return made;
}

void CoupledSolve::count_preparation(std::chrono::steady_clock::time_point begin, const SparseFactor& made,
                                     SolveReport& report) {
  ++report.preparations;
  report.making += made.making();
  report.once += made.once();
  report.work += made.making() + made.once();
  report.preparation_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void CoupledSolve::take_whole(const BlockMatrix& A, SolveReport& report) {
  way_ = Way::whole;
  whole_keys_ = keys_;
  if (whole_ == nullptr) whole_ = std::make_unique<SparseFactor>();
  if (!whole_->is_of(A, true)) {
    const auto begin = std::chrono::steady_clock::now();
    whole_->make(A, true);
    count_preparation(begin, *whole_, report);
  }
  definite_ = whole_->is_definite();
}

void CoupledSolve::again(SparseFactor& of_matrix, ConstReals b, Reals x) {
  if (way_ == Way::whole) {
    whole_->solve(b, x);
  } else if (way_ == Way::capacitance) {
    capacitance_.solve(of_matrix, b, x);
  } else {
    iterate(*matrix_, of_matrix, b, x);
  }
}

/// The conjugate gradient from zero (Golub and Van Loan, Matrix Computations, 4th edition, 11.5).
bool CoupledSolve::iterate(const BlockMatrix& A, SparseFactor& of_matrix, ConstReals b, Reals x) {
  for (auto* vector : {&r_, &z_, &p_, &q_}) vector->resize(b.size());
  std::ranges::copy(b, r_.begin());
  std::ranges::fill(x, 0.0);
  std::ranges::fill(p_, 0.0);
  const double target = kReached * norm(b);
  double before = 1.0;
  for (left_ = kMostIterations; left_ > 0; --left_) {
    of_matrix.solve(r_, z_);
    const double rz = product(r_, z_);
    if (!(rz > 0.0)) return norm(r_) <= target;
    const double beta = left_ == kMostIterations ? 0.0 : rz / before;
    for (std::size_t i = 0; i < p_.size(); ++i) p_[i] = z_[i] + beta * p_[i];
    A.multiply(p_, q_);
    const double curvature = product(p_, q_);
    if (!(curvature > 0.0)) return false;
    const double alpha = rz / curvature;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      x[i] += alpha * p_[i];
      r_[i] -= alpha * q_[i];
    }
    before = rz;
    if (norm(r_) <= target) {
      --left_;
      return true;
    }
  }
  return false;
}

void CoupledSolve::forget() {
  capacitance_.forget();
  if (whole_ != nullptr) whole_->forget();
  whole_keys_.clear();
}

std::size_t CoupledSolve::bytes() const {
  return capacitance_.bytes() + (whole_ == nullptr ? 0 : whole_->bytes()) +
         (r_.size() + z_.size() + p_.size() + q_.size()) * sizeof(double);
}

}  // namespace tissu
