#include "tissu/step/static_equilibrium.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr double kShortest = 1e-3;  ///< a Newton step is not cut below this
constexpr double kHopeless = 1e9;   ///< times the load: Newton's iteration has lost its way
constexpr int kHalvings = 12;       ///< of a part of the load

}  // namespace

StaticEquilibrium::StaticEquilibrium(Settings settings) : settings_(settings) {
  if (settings.load_steps < 1 || settings.newton.iterations < 1 || !(settings.newton.tolerance > 0.0)) {
    throw ParameterError(
        "static equilibrium needs at least one load step, one Newton iteration and a positive tolerance.");
  }
}

void StaticEquilibrium::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  system_ = std::make_unique<System>(world, solver, profile);
  before_ = world.rest_state();
  const std::size_t size = before_.positions.size();
  for (auto* v : {&change_, &right_, &work_}) v->assign(size, 0.0);
}

StepReport StaticEquilibrium::step(State& state, double h) {
  StepReport report;
  state.time += h;
  std::ranges::fill(state.velocities, 0.0);
  double done = 0.0;
  double part = 1.0 / settings_.load_steps;
  const double smallest = std::ldexp(part, -kHalvings);
  while (done < 1.0) {
    before_ = state;
    const double to = std::min(1.0, done + part * (1.0 + 1e-12));
    state.load_factor = loaded_ ? 1.0 : to;
    if (equilibrate(state, (to - done) / (1.0 - done), report)) {
      done = to >= 1.0 - 1e-12 ? 1.0 : to;
      continue;
    }
    if (part < 2.0 * smallest) break;
    part *= 0.5;
    state = before_;
  }
  report.converged = done >= 1.0;
  if (!report.converged) {
    report.message =
        "no equilibrium was found beyond " + number_text(100.0 * done) +
        " % of the load; give Newton's method more iterations, or let a damped body come to rest " +
        "in steps of time (implicit_euler, rayleigh)";
    state = before_;
  }
  state.load_factor = 1.0;
  loaded_ = loaded_ || report.converged;
  report.time = state.time;
  return report;
}

double StaticEquilibrium::residual(const State& state) {
  system_->force(state, right_);
  system_->world().fixed().clear(right_);
  return norm(right_);
}

bool StaticEquilibrium::equilibrate(State& state, double share, StepReport& report) {
  if (iterate(state, share, LineSearch::off, report)) return true;
  const double time = state.time;
  const double factor = state.load_factor;
  state = before_;
  state.time = time;
  state.load_factor = factor;
  return iterate(state, share, LineSearch::on, report);
}

bool StaticEquilibrium::iterate(State& state, double share, LineSearch search, StepReport& report) {
  const FixedDofs& fixed = system_->world().fixed();
  double reference = std::max(system_->external_force(state, work_), 1e-300);
  double now = residual(state);

  // The way of the led nodes, taken by the whole body in its linear answer.
  std::ranges::fill(work_, 0.0);
  fixed.set_velocities(state, state.time, 1.0, share, work_);
  bool led = std::ranges::any_of(work_, [](double w) { return w != 0.0; });
  if (led) system_->add_product(state, {1.0, 0.0}, work_, right_);

  for (int i = 0; i <= settings_.newton.iterations; ++i) {
    if (i <= 1) reference = std::max(reference, now);
    report.residual = now / reference;
    if (!(report.residual < kHopeless)) return false;
    if (!led && report.residual <= settings_.newton.tolerance) return true;
    if (i == settings_.newton.iterations) return false;
    stop_if_asked();
    system_->assemble(state, 0.0, {-1.0, 0.0});
    if (!led && now <= system_->round_off(state)) return true;
    fixed.clear(right_);
    if (led) {
      for (std::size_t k = 0; k < right_.size(); ++k) right_[k] += work_[k];
    }
    std::ranges::copy(work_, change_.begin());
    report.solver_iterations += system_->solve(right_, change_, 0.0).iterations;
    ++report.newton_iterations;
    const double next = go(state, search == LineSearch::on && !led ? now : kHopeless);
    if (search == LineSearch::on && !led && !(next < now)) return false;
    led = false;
    std::ranges::fill(work_, 0.0);
    now = next;
  }
  return false;
}

double StaticEquilibrium::go(State& state, double below) {
  from_ = state;
  double length = 1.0;
  while (true) {
    for (std::size_t k = 0; k < right_.size(); ++k) right_[k] = length * change_[k];
    move(from_, system_->world().frames(), right_, 1.0, state);
    const double next = residual(state);
    if (next < below || below == kHopeless || length < kShortest) return next;
    length *= 0.5;
  }
}

}  // namespace tissu
