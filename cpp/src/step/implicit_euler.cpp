#include "tissu/step/implicit_euler.h"

#include <algorithm>

#include "tissu/base/error.h"
#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr double kFloor = 1e-3;  ///< of the external impulse: a smaller right-hand side is judged against it
constexpr double kHopeless = 1e9;   ///< times the first residual: Newton's iteration has lost its way
constexpr double kShortest = 1e-3;  ///< a Newton step is not cut below this

}  // namespace

ImplicitEuler::ImplicitEuler(NewtonSettings newton) : newton_(newton) {
  if (newton.iterations < 1 || !(newton.tolerance > 0.0)) {
    throw ParameterError("Newton's iteration needs at least one iteration and a positive tolerance.");
  }
}

void ImplicitEuler::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  system_ = std::make_unique<System>(world, solver, profile);
  start_ = world.rest_state();
  const std::size_t size = start_.positions.size();
  for (auto* v : {&v_, &first_, &trial_, &change_, &right_, &work_}) v->assign(size, 0.0);
}

StepReport ImplicitEuler::step(State& state, double h) {
  const World& world = system_->world();
  StepReport report;
  start_ = state;
  start_.time += h;  // loads and led nodes act with their value at the end of the step
  v_ = state.velocities;

  system_->external_force(start_, work_);
  reference_ = h * norm(work_);
  first_solve(h, report);
  if (newton_.iterations > 1) newton(state, h, report);

  move(start_, world.frames(), v_, h, state);
  state.velocities = v_;
  keep_angular_momentum(start_, world.frames(), state);
  state.time = start_.time;
  report.time = state.time;
  return report;
}

void ImplicitEuler::first_solve(double h, StepReport& report) {
  const World& world = system_->world();
  const FixedDofs& fixed = world.fixed();
  // Changes of velocity that are given, zero elsewhere.
  trial_ = v_;
  fixed.set_velocities(start_.positions, start_.time, h, 1.0, trial_);
  for (std::size_t i = 0; i < v_.size(); ++i) change_[i] = trial_[i] - v_[i];

  // h f0 + h^2 K (v0 + given) + h D given - M given
  system_->force(start_, right_);
  for (double& r : right_) r *= h;
  system_->add_product(start_, {h * h, 0.0}, trial_, right_);
  const bool led = std::ranges::any_of(change_, [](double c) { return c != 0.0; });
  if (led) {
    system_->add_product(start_, {0.0, h}, change_, right_);
    world.mass().add_product(start_, -1.0, change_, right_);
  }
  for (const std::int32_t row : fixed.rows()) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((fixed.masks()[static_cast<std::size_t>(row)] >> axis) & 1) == 0) continue;
      const auto i = static_cast<std::size_t>(3 * row + axis);
      right_[i] = change_[i];
    }
  }

  system_->assemble(start_, 1.0, {-h * h, -h});
  const SolveReport solved = system_->solve(right_, change_, kFloor * reference_);
  for (std::size_t i = 0; i < v_.size(); ++i) v_[i] += change_[i];
  report.newton_iterations = 1;
  report.solver_iterations = solved.iterations;
  report.residual = solved.residual;
  report.converged = solved.converged;
  if (!solved.positive_definite) {
    report.message = "the tangent is not positive definite: the step was taken along a descent direction";
  } else if (!solved.converged) {
    report.message = "the linear solver stopped before its tolerance";
  }
}

double ImplicitEuler::residual(State& state, double h, ConstReals v) {
  const World& world = system_->world();
  state.time = start_.time;
  move(start_, world.frames(), v, h, state);
  std::ranges::copy(v, state.velocities.begin());
  system_->force(state, right_);
  for (std::size_t i = 0; i < right_.size(); ++i) {
    right_[i] *= h;
    work_[i] = v[i] - start_.velocities[i];
  }
  world.mass().add_product(start_, -1.0, work_, right_);
  world.fixed().clear(right_);
  return norm(right_);
}

void ImplicitEuler::newton(State& state, double h, StepReport& report) {
  first_ = v_;
  if (!iterate(state, h, LineSearch::off, report)) {
    v_ = first_;
    report.newton_iterations = 1;
    iterate(state, h, LineSearch::on, report);
  }
}

bool ImplicitEuler::iterate(State& state, double h, LineSearch search, StepReport& report) {
  double now = residual(state, h, v_);
  const double reference = std::max({reference_, now, 1e-300});
  report.converged = false;
  while (true) {
    report.residual = now / reference;
    if (!(report.residual < kHopeless)) {
      report.message = "Newton's iteration ran away";
      return false;
    }
    if (report.residual <= newton_.tolerance) break;
    if (report.newton_iterations >= newton_.iterations) {
      report.message = "Newton's iteration stopped before its tolerance";
      return false;
    }
    system_->assemble(state, 1.0, {-h * h, -h});
    if (now <= system_->round_off(state) / h) break;
    std::ranges::fill(change_, 0.0);
    report.solver_iterations += system_->solve(right_, change_, 0.0).iterations;
    ++report.newton_iterations;
    double share = 1.0;
    double next = 0.0;
    while (true) {
      for (std::size_t i = 0; i < v_.size(); ++i) trial_[i] = v_[i] + share * change_[i];
      next = residual(state, h, trial_);
      if (search == LineSearch::off || next < now || share < kShortest) break;
      share *= 0.5;
    }
    if (search == LineSearch::on && !(next < now)) {
      report.message = "Newton's residual could not be lowered further";
      return false;
    }
    std::swap(v_, trial_);
    now = next;
  }
  report.converged = true;
  report.message.clear();
  return true;
}

}  // namespace tissu
