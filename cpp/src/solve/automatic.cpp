#include "tissu/solve/automatic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "ahead.h"
#include "arm_costs.h"
#include "choice.h"
#include "tissu/assembly/couplings.h"
#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/number_text.h"
#include "tissu/solve/cholesky.h"
#include "tissu/solve/conjugate_gradient.h"

namespace tissu {
namespace {

constexpr int kIterations = 20'000;
constexpr std::size_t kManyCouplings = 16;
constexpr double kRowsOfFactor = 1000.0;  ///< of three, beside many couplings
constexpr double kFactorBytes = 2e9;      ///< a larger factor is not made
constexpr double kSolvesSteps = 8.0;      ///< that are to pay for the first preparation
constexpr double kSolvesNewton = 4.0;
constexpr double kFrame = 3.0;    ///< solves that one of a trial may take, as the first step of a scene may
constexpr double kNewSize = 0.1;  ///< of rows and blocks: a matrix of another size is not compared
constexpr double kOfPlain = 3.2;  ///< iterations of block-Jacobi for one of incomplete Cholesky
constexpr double kUnfinished = 2.0;  ///< times the iterations of a solve that was left: those of a whole one
constexpr double kRemember = 1.0 / 16.0;

std::unique_ptr<LinearSolver> solver_of(Arm arm, double tolerance) {
  using P = Preconditioning;
  const auto gradient = [&](P kind, Precision precision) {
    return std::make_unique<ConjugateGradient>(
        ConjugateGradient::Settings{tolerance, kIterations, kind, precision, Product::assembled});
  };
  switch (arm) {
    case Arm::block_jacobi:
      return gradient(P::block_jacobi, Precision::single);
    case Arm::incomplete_cholesky:
      return gradient(P::incomplete_cholesky, Precision::single);
    case Arm::multigrid:
      return gradient(P::multigrid, Precision::single);
    case Arm::stale_cholesky:
      return gradient(P::stale_cholesky, Precision::full);
    case Arm::cholesky:
      break;
  }
  return std::make_unique<Cholesky>();
}

constexpr ForArms<std::string_view> kNames = {
    "automatic: conjugate gradient, block-Jacobi", "automatic: conjugate gradient, incomplete Cholesky",
    "automatic: conjugate gradient, multigrid", "automatic: conjugate gradient, stale Cholesky",
    "automatic: Cholesky"};

void add(const SolveReport& report, SolveReport& sum) {
  sum.iterations += report.iterations;
  sum.residual = report.residual;
  sum.converged = report.converged;
  sum.positive_definite = report.positive_definite;
  sum.preparations += report.preparations;
  sum.preparation_seconds += report.preparation_seconds;
  sum.work += report.work;
  sum.making += report.making;
  sum.once += report.once;
}

/// `left`: what an attempt before this one left of the digits.
Spent spent(const SolveReport& report, double left = 1.0) {
  return {report.making, report.once, (report.work - report.making - report.once) / left};
}

}  // namespace

struct Automatic::Known {
  std::uint64_t id = 0;
  std::uint64_t version = 0;
  MatrixShape shape;
  double plain = 0.0;  ///< iterations of block-Jacobi: predicted, or counted by it or by a like one
  Changes changes;
  bool touched =
      false;  ///< many couplings came and went: a factor of the matrix without them is of little use
};

Automatic::Automatic(Settings settings)
    : settings_(settings),
      choice_(std::make_unique<Choice>()),
      known_(std::make_unique<Known>()),
      ahead_(std::make_unique<Ahead>()),
      solvers_(kArms),
      solves_(kArms, 0) {
  if (!(settings.tolerance > 0.0)) {
    throw ParameterError("the automatic solver needs a positive tolerance.");
  }
}

Automatic::~Automatic() = default;

LinearSolver& Automatic::solver(Arm arm) {
  std::unique_ptr<LinearSolver>& solver = solvers_[number(arm)];
  if (solver == nullptr) solver = solver_of(arm, settings_.tolerance);
  return *solver;
}

void Automatic::predict(bool first) {
  ForArms<Cost> costs = predicted_costs(known_->shape, known_->plain, settings_.tolerance, known_->changes,
                                        settings_.equilibrium);
  const bool fits =
      factor_bytes(known_->shape) <= kFactorBytes && !(known_->touched && known_->shape.rows > kRowsOfFactor);
  for (const Arm arm : {Arm::stale_cholesky, Arm::cholesky}) {
    if (!fits) costs[number(arm)].solving = std::numeric_limits<double>::infinity();
  }
  if (first) {
    changes_ += choice_->changes();
    choice_->begin(costs, settings_.equilibrium ? kSolvesNewton : kSolvesSteps,
                   settings_.equilibrium ? Choice::kNever : kFrame);
  } else {
    choice_->predict(costs);
  }
}

void Automatic::meet(const BlockMatrix& A) {
  Known& known = *known_;
  const auto bytes = static_cast<double>(A.bytes());
  known.touched = known.touched || (A.couplings() != nullptr && A.couplings()->size() > kManyCouplings);
  const bool first = known.id == 0 || std::abs(bytes - known.shape.bytes) > kNewSize * known.shape.bytes;
  if (first) {
    known.shape = shape_of(A, settings_.equilibrium);
    known.plain = plain_iterations(known.shape, settings_.tolerance, settings_.equilibrium);
    known.changes = Changes();
  } else {
    const bool other = known.id != A.id();
    const bool changed = other || known.version != A.values_version();
    known.changes.values += kRemember * ((changed ? 1.0 : 0.0) - known.changes.values);
    known.changes.pattern += kRemember * ((other ? 1.0 : 0.0) - known.changes.pattern);
  }
  predict(first);
  known.id = A.id();
  known.version = A.values_version();
}

void Automatic::meet_after(const LinearOperator& A) {
  const bool waited = ahead_->waits();
  if (waited && ahead_->serves(A)) {
    known_->version = A.values_version();
    return;
  }
  if (waited) forget();
  meet(*A.matrix());
}

bool Automatic::prepare_ahead(const LinearOperator& A) {
  if (A.matrix() == nullptr || A.couplings() != nullptr) return false;
  meet(*A.matrix());
  const bool made = solver(choice_->current()).prepare_ahead(A);
  ahead_->made(A);
  return made;
}

SolveReport Automatic::attempt(const LinearOperator& A, ConstReals b, Reals x, double floor, double left) {
  const Arm arm = choice_->current();
  LinearSolver& solver = this->solver(arm);
  if (arm == Arm::cholesky) return solver.solve(A, b, x, floor);
  static_cast<ConjugateGradient&>(solver).allow(choice_->allowance());
  const SolveReport report = solver.solve(A, b, x, floor);
  const double of_plain = arm == Arm::incomplete_cholesky ? kOfPlain : 1.0;
  const double plain = of_plain * report.iterations / left;
  if (report.iterations == 0 || (arm != Arm::block_jacobi && arm != Arm::incomplete_cholesky)) return report;
  known_->plain = report.converged ? plain : std::max(known_->plain, kUnfinished * plain);
  return report;
}

SolveReport Automatic::solve(const LinearOperator& A, ConstReals b, Reals x, double floor) {
  if (A.matrix() == nullptr) throw ParameterError("the automatic solver needs an assembled matrix.");
  meet_after(A);
  choice_->begin_solve();
  SolveReport sum;
  double left = 1.0;
  while (true) {
    const Arm arm = choice_->current();
    SolveReport report;
    try {
      report = attempt(A, b, x, floor, left);
    } catch (const Interrupted&) {
      throw;
    } catch (const Error&) {  // a factor that cannot be made
      if (!choice_->leave(0.0, true)) throw;
      continue;
    }
    add(report, sum);
    if (!report.converged) predict(false);  // what it took says something of the others
    if (report.converged || !report.positive_definite) {
      ++solves_[number(arm)];
      // A first guess that is the answer says nothing of the others.
      if (report.converged && report.iterations > 0) choice_->used(spent(report, left));
      break;
    }
    left = digits_left(report.residual, settings_.tolerance);
    const double solving = spent(report).solving;
    if (!choice_->leave(solving, solving < choice_->allowance())) break;
  }
  drop();
  return sum;
}

void Automatic::drop() {
  for (const Arm arm : kAllArms) {
    if (arm != choice_->current() && arm != choice_->spare()) solvers_[number(arm)].reset();
  }
}

void Automatic::forget() {
  for (auto& solver : solvers_) solver.reset();
  *known_ = Known();
  *ahead_ = Ahead();
}

std::size_t Automatic::bytes() const {
  std::size_t sum = 0;
  for (const auto& solver : solvers_) sum += solver == nullptr ? 0 : solver->bytes();
  return sum;
}

std::string_view Automatic::name() const {
  return known_->id == 0 ? "automatic" : kNames[number(choice_->current())];
}

std::string Automatic::account() const {
  std::ostringstream text;
  const char* between = "";
  std::int64_t last = 0;
  for (const Arm arm : kAllArms) {
    if (solves_[number(arm)] == 0) continue;
    last = solves_[number(arm)];
    text << between << name_of(arm) << " in " << last;
    between = ", ";
  }
  if (last == 0) return {};
  const int changes = changes_ + choice_->changes();
  text << (last == 1 ? " system; it " : " systems; it ");
  if (changes == 0) text << "never changed";
  if (changes == 1) text << "changed once";
  if (changes > 1) text << "changed " << changes << " times";
  if (known_->id == 0) return text.str();
  between = "; work of a system [MB]: ";
  for (const Arm arm : kAllArms) {
    const double rate = choice_->cost(arm).rate();
    if (!std::isfinite(rate)) continue;
    text << between << name_of(arm) << " " << number_text(1e-6 * rate)
         << (choice_->is_counted(arm) ? "" : " (predicted)");
    between = ", ";
  }
  return text.str();
}

}  // namespace tissu
