#include "tissu/step/tangent_solve.h"

#include <algorithm>
#include <numeric>

#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr std::size_t kMost = 40;     ///< iterations
constexpr double kTolerance = 1e-8;   ///< on |b - K x| / |b| under moments, …
constexpr double kIndefinite = 1e-3;  ///< … and where K is indefinite: Newton's method goes on by so much
constexpr std::size_t kRound = 8;     ///< iterations, …
constexpr double kFall = 0.1;  ///< … in which the residual of an indefinite K falls by so much, or never will
constexpr double kRaised = 4.0;     ///< share of the definite matrix, where it does not do
constexpr double kAccepted = 1e-2;  ///< with which a Newton step is still worth taking

double dot(ConstReals a, ConstReals b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

/// y += a x
void add(double a, ConstReals x, Reals y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += a * x[i];
}

}  // namespace

SolveReport TangentSolve::solve(const State& state, ConstReals b, Reals x) {
  std::ranges::fill(x, 0.0);
  system_.assemble(state, mass_, {-1.0, 0.0});
  has_moments_ = find_moments(state);
  const SolveReport report = system_.solve(b, x, 0.0);
  if (report.positive_definite && !has_moments_) return report;
  if (!report.positive_definite) system_.assemble(state, mass_, {-1.0, 0.0, true});
  SolveReport more = iterate(state, b, x);
  more.iterations += report.iterations;
  more.positive_definite = report.positive_definite;
  return more;
}

bool TangentSolve::find_moments(const State& state) {
  const World& world = system_.world();
  if (world.frames().empty()) return false;
  moments_.resize(state.positions.size());
  if (!(system_.external_force(state, moments_) > 0.0)) return false;
  const bool any = std::ranges::any_of(world.frames(), [&](const Frame& frame) {
    return !block(ConstReals(moments_), frame.rotation).isZero(0.0);
  });
  if (!any) return false;
  std::ranges::fill(moments_, 0.0);
  for (const auto& model : world.forces()) {
    if (model->kind() == ForceKind::elastic) model->add_force(state, system_.scratch(), moments_);
  }
  return true;
}

void TangentSolve::multiply(const State& state, ConstReals p, Reals q) {
  std::ranges::fill(q, 0.0);
  system_.add_product(state, {-1.0, 0.0}, p, q);
  if (has_moments_) {
    for (const Frame& frame : system_.world().frames()) {
      const Vec3 moment = block(ConstReals(moments_), frame.rotation);
      block(q, frame.rotation) += 0.5 * moment.cross(block(p, frame.rotation));
    }
  }
  system_.world().fixed().clear(q);
}

SolveReport TangentSolve::solve_mean(const State& state, ConstReals b, Reals x, double& share) {
  int iterations = 0;
  while (true) {
    std::ranges::fill(x, 0.0);
    if (share < 1.0) {
      system_.assemble_mean(state, share, mass_);
    } else {
      system_.assemble(state, mass_, {-1.0, 0.0, true});
    }
    SolveReport report = system_.solve(b, x, 0.0);
    iterations += report.iterations;
    if (report.positive_definite || share >= 1.0) {
      report.iterations = iterations;
      return report;
    }
    share = std::min(1.0, kRaised * share);
  }
}

bool TangentSolve::is_indefinite(const State& state, ConstReals b, Reals x) {
  if (find_moments(state)) return false;
  std::ranges::fill(x, 0.0);
  system_.assemble(state, mass_, {-1.0, 0.0});
  return !system_.solve(b, x, 0.0).positive_definite;
}

SolveReport TangentSolve::iterate(const State& state, ConstReals b, Reals x) {
  SolveReport report;
  std::ranges::fill(x, 0.0);
  left_.assign(b.begin(), b.end());
  const double size = norm(b);
  double now = size;
  double of_round = size;
  const double tolerance = has_moments_ ? kTolerance : kIndefinite;
  for (std::size_t n = 0; n < kMost && now > tolerance * size; ++n) {
    if (n > 0 && n % kRound == 0) {
      if (!has_moments_ && now > kFall * of_round) break;
      of_round = now;
    }
    if (directions_.size() == n) {
      directions_.emplace_back(b.size());
      products_.emplace_back(b.size());
    }
    std::vector<double>& p = directions_[n];
    std::vector<double>& q = products_[n];
    p.assign(b.size(), 0.0);
    q.assign(b.size(), 0.0);
    report.iterations += system_.solve(left_, p, 0.0).iterations;
    system_.world().fixed().clear(p);
    multiply(state, p, q);
    for (std::size_t k = 0; k < n; ++k) {
      const double share = dot(q, products_[k]);
      add(-share, products_[k], q);
      add(-share, directions_[k], p);
    }
    const double length = norm(q);
    if (!(length > 0.0)) break;
    for (double& value : q) value /= length;
    for (double& value : p) value /= length;
    const double along = dot(left_, q);
    add(along, p, x);
    add(-along, q, left_);
    now = norm(left_);
  }
  report.residual = size > 0.0 ? now / size : 0.0;
  report.converged = report.residual <= kAccepted;
  return report;
}

}  // namespace tissu
