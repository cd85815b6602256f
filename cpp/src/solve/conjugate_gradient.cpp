#include "tissu/solve/conjugate_gradient.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "ahead.h"
#include "forecast.h"
#include "iteration.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

/// How far iterations in single precision lower a residual, and how many there are, before it is computed
/// again in double.
constexpr double kSingleDepth = 1e-2;
constexpr int kSingleIterations = 100;
/// A residual this many times what the iterations count themselves: single precision has lost its way.
constexpr double kFaithful = 3.0;
/// Iterations that it may take without halving the residual, beside a quarter of those before.
constexpr int kPatience = 200;
/// Solves that go without single precision after it has failed, at most.
constexpr int kLongestPause = 64;

/// Whether single precision still lowers the residual.
struct Progress {
  double best;      ///< residual
  int lowered = 0;  ///< iterations at which it was found

  bool goes_on(double size, int iterations, int allowed) {
    if (size < 0.5 * best) {
      best = size;
      lowered = iterations;
    }
    return iterations - lowered < kPatience + lowered / 4 && 2 * iterations < allowed;
  }
};

std::string name_of(const ConjugateGradient::Settings& settings) {
  std::string name = "conjugate gradient, ";
  switch (settings.preconditioning) {
    case Preconditioning::jacobi:
      name += "Jacobi";
      break;
    case Preconditioning::block_jacobi:
      name += "block-Jacobi";
      break;
    case Preconditioning::incomplete_cholesky:
      name += "incomplete Cholesky";
      break;
    case Preconditioning::stale_cholesky:
      name += "stale Cholesky";
      break;
    case Preconditioning::multigrid:
      name += "multigrid";
      break;
  }
  if (settings.precision == Precision::single) name += ", single precision";
  if (settings.product == Product::free) name += ", matrix-free";
  return name;
}

}  // namespace

ConjugateGradient::ConjugateGradient(Settings settings)
    : settings_(settings),
      name_(name_of(settings)),
      forecast_(std::make_unique<Forecast>()),
      ahead_(std::make_unique<Ahead>()) {
  if (!(settings.tolerance > 0.0) || settings.iterations < 1) {
    throw ParameterError("conjugate gradient needs a positive tolerance and at least one iteration.");
  }
  const bool diagonal = settings.preconditioning == Preconditioning::jacobi ||
                        settings.preconditioning == Preconditioning::block_jacobi;
  if (settings.product == Product::free && (!diagonal || settings.precision == Precision::single)) {
    throw ParameterError(
        "conjugate gradient without a matrix works in double precision with a Jacobi or block-Jacobi "
        "preconditioner; assemble the matrix for others.");
  }
}

ConjugateGradient::~ConjugateGradient() = default;

template <>
Iteration<double>& ConjugateGradient::iteration() {
  if (!full_) full_ = std::make_unique<Iteration<double>>(settings_.preconditioning);
  return *full_;
}
template <>
Iteration<float>& ConjugateGradient::iteration() {
  if (!single_) single_ = std::make_unique<Iteration<float>>(settings_.preconditioning);
  return *single_;
}

double ConjugateGradient::residual(const LinearOperator& A, ConstReals b, ConstReals x, SolveReport& report) {
  r_.resize(b.size());
  const bool zero = std::ranges::all_of(x, [](double value) { return value == 0.0; });
  if (zero) {
    std::ranges::copy(b, r_.begin());
  } else {
    A.multiply(x, r_);
    report.work += static_cast<double>(A.bytes());
    for (std::size_t i = 0; i < r_.size(); ++i) r_[i] = b[i] - r_[i];
  }
  return std::sqrt(dot<double>(A.threads(), r_, r_, partial_));
}

double ConjugateGradient::spent(const SolveReport& report) const {
  return report.work + (full_ ? full_->solving() : 0.0) + (single_ ? single_->solving() : 0.0);
}

template <class T, class V>
int ConjugateGradient::left(const LinearOperator& A, const SolveReport& report) {
  const int most = settings_.iterations - report.iterations;
  const double allowed = (allowance_ - spent(report)) / iteration<T>().template iteration_work<V>(A);
  return allowed < most ? std::max(1, static_cast<int>(allowed)) : most;
}

template <class T, class V>
void ConjugateGradient::prepare(const LinearOperator& A, bool forced, SolveReport& report) {
  const auto begin = std::chrono::steady_clock::now();
  if (!iteration<T>().template prepare<V>(A, forced)) return;
  ++report.preparations;
  report.preparation_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

template <class T>
End ConjugateGradient::double_round(const LinearOperator& A, Reals x, double target, SolveReport& report) {
  Iteration<T>& iteration = this->iteration<T>();
  change_.resize(r_.size());
  const End end = iteration.template run<double>(A, r_, change_, target, left<T, double>(A, report));
  report.iterations += iteration.iterations();
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += change_[i];
  return end;
}

/// The same with the residual divided by its length, so that no number leaves the range of single precision.
End ConjugateGradient::single_round(const LinearOperator& A, Reals x, double length, double target,
                                    SolveReport& report) {
  Iteration<float>& iteration = this->iteration<float>();
  single_r_.resize(r_.size());
  single_change_.resize(r_.size());
  for (std::size_t i = 0; i < r_.size(); ++i) single_r_[i] = static_cast<float>(r_[i] / length);
  const double depth = std::max(0.5 * target / length, kSingleDepth);
  const int most = std::min(kSingleIterations, left<float, float>(A, report));
  const End end = iteration.run<float>(A, single_r_, single_change_, depth, most);
  report.iterations += iteration.iterations();
  if (end == End::lost) return end;
  const double scale = length * iteration.scale();
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += scale * static_cast<double>(single_change_[i]);
  return end;
}

bool ConjugateGradient::prepare_ahead(const LinearOperator& A) {
  if (A.matrix() == nullptr || A.couplings() != nullptr) return false;
  const Way way = first_way();
  if (way == Way::full) iteration<double>().prepare<double>(A, false);
  if (way == Way::mixed) iteration<float>().prepare<double>(A, false);
  if (way == Way::single) iteration<float>().prepare<float>(A, false);
  ahead_->made(A);
  return true;
}

void ConjugateGradient::begin_solve(const LinearOperator& A) {
  const bool waited = ahead_->waits();
  const bool serves = waited && ahead_->serves(A);
  if (waited && !serves) forget();
  if (full_) full_->begin_solve();
  if (single_) single_->begin_solve();
  if (serves && full_) full_->take_over(A);
  if (serves && single_) single_->take_over(A);
}

SolveReport ConjugateGradient::solve(const LinearOperator& A, ConstReals b, Reals x, double floor) {
  if (needs_matrix() && A.matrix() == nullptr) {
    throw ParameterError("this conjugate gradient needs an assembled matrix.");
  }
  SolveReport report;
  const double reference = std::max(std::sqrt(dot<double>(A.threads(), b, b, partial_)), floor);
  if (reference == 0.0) {
    std::ranges::fill(x, 0.0);
    report.converged = true;
    return report;
  }
  begin_solve(A);
  rounds(A, b, x, reference, report);
  report.making = (full_ ? full_->making() : 0.0) + (single_ ? single_->making() : 0.0);
  report.once = (full_ ? full_->once() : 0.0) + (single_ ? single_->once() : 0.0);
  report.work = spent(report) + report.making + report.once;
  if (full_) full_->end_solve();
  if (single_) single_->end_solve();
  if (report.converged) forecast_->keep(A, x);
  return report;
}

ConjugateGradient::Way ConjugateGradient::first_way() const {
  if (settings_.precision == Precision::full) return Way::full;
  // Its cycle reads the matrix of each level several times, so a product in double costs little beside it.
  if (settings_.preconditioning == Preconditioning::multigrid) return Way::mixed;
  return pause_ > 0 ? Way::mixed : Way::single;
}

End ConjugateGradient::round(Way way, const LinearOperator& A, Reals x, double size, double target,
                             bool renew, SolveReport& report) {
  if (way == Way::full) {
    prepare<double, double>(A, renew, report);
    return double_round<double>(A, x, target, report);
  }
  if (way == Way::mixed) {
    prepare<float, double>(A, renew, report);
    return double_round<float>(A, x, target, report);
  }
  prepare<float, float>(A, renew, report);
  return single_round(A, x, size, target, report);
}

void ConjugateGradient::rounds(const LinearOperator& A, ConstReals b, Reals x, double reference,
                               SolveReport& report) {
  Way way = first_way();
  pause_ = std::max(0, pause_ - 1);
  bool renew = false;
  const bool zero = std::ranges::all_of(x, [](double value) { return value == 0.0; });
  double size = residual(A, b, x, report);
  if (zero && size > settings_.tolerance * reference) size = forecast_->start(A, size, r_, x, report.work);
  Progress progress{size};
  double before = size;
  bool counted = false;  // by the iterations, not computed from x
  for (int round = 0;; ++round) {
    const bool last = report.iterations >= settings_.iterations || spent(report) >= allowance_;
    if (counted && last) size = residual(A, b, x, report);
    if (!counted || last) {
      report.residual = size / reference;
      report.converged = report.residual <= settings_.tolerance;
      if (!report.converged && round > 0) {
        report.converged = report.residual <= attainable(A, x, reference, settings_.tolerance);
      }
      if (report.converged && way == Way::single && round > 0) pauses_ = 0;
      if (report.converged || last) return;
      before = size;
    }
    const End end = this->round(way, A, x, size, settings_.tolerance * reference, renew, report);
    renew = end == End::renewal;
    counted = end == End::part;
    if (counted) {
      if (way == Way::full) full_->go_on<double>(1.0);
      if (way == Way::mixed) single_->go_on<double>(1.0);
      size = way == Way::full ? full_->residual() : single_->residual();
      continue;
    }
    size = residual(A, b, x, report);
    if (renew) continue;
    if (way == Way::single) {
      const bool serves = (end == End::reached || end == End::exhausted) &&
                          size < kFaithful * before * single_->residual() &&
                          progress.goes_on(size, report.iterations, settings_.iterations);
      if (serves) {
        single_->go_on<float>(size / before);
        continue;
      }
      way = Way::mixed;
      pause_ = pauses_ = std::clamp(2 * pauses_, 1, kLongestPause);
      continue;
    }
    if (end == End::reached && size < 0.5 * before) {
      if (way == Way::full) full_->go_on<double>(1.0);
      if (way == Way::mixed) single_->go_on<double>(1.0);
      continue;
    }
    report.residual = size / reference;
    report.positive_definite = end == End::reached || end == End::exhausted;
    report.converged =
        report.positive_definite && report.residual <= attainable(A, x, reference, settings_.tolerance);
    if (report.positive_definite || way == Way::full) return;
    way = Way::full;  // what looked like a negative curvature may be the preconditioner's round-off
  }
}

void ConjugateGradient::forget() {
  if (full_) full_->forget();
  if (single_) single_->forget();
  forecast_->forget();
  pause_ = pauses_ = 0;
  *ahead_ = Ahead();
}

std::size_t ConjugateGradient::bytes() const {
  const std::size_t vectors = (r_.size() + change_.size()) * sizeof(double) +
                              (single_r_.size() + single_change_.size()) * sizeof(float);
  return vectors + forecast_->bytes() + (full_ ? full_->bytes() : 0) + (single_ ? single_->bytes() : 0);
}

}  // namespace tissu
