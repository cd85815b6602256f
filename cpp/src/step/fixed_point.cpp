#include "tissu/step/fixed_point.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/number_text.h"
#include "tissu/step/frequency.h"

namespace tissu {
namespace {

constexpr double kHopeless = 1e6;    ///< times the first residual: the iteration does not contract
constexpr double kLeast = 1.0 / 64;  ///< share of a change that is taken

}  // namespace

Bdf2FixedPoint::Bdf2FixedPoint(Settings settings)
    : settings_(settings), solver_(NewtonSettings{}, {}), anderson_(settings.anderson) {
  if (settings.iterations < 1 || !(settings.tolerance > 0.0) || settings.anderson < 0 ||
      settings.anderson > Anderson::kMost) {
    throw ParameterError(
        "the fixed-point iteration needs at least one iteration, a positive tolerance, and 0 to 8 "
        "differences "
        "for Anderson's acceleration.");
  }
}

std::string_view Bdf2FixedPoint::name() const {
  return settings_.anderson > 0 ? "BDF2, fixed point with Anderson's acceleration" : "BDF2, fixed point";
}

void Bdf2FixedPoint::prepare(const World& world, LinearSolver* /*solver*/, Profile& profile) {
  solver_.prepare(world, nullptr, profile);
  history_.prepare(world);
  start_ = world.rest_state();
  v_ = start_.velocities;
  change_ = v_;
  anderson_.resize(v_.size());
  weight_.clear();
  for (const double m : world.mass().nodal()) weight_.insert(weight_.end(), 3, m);
}

StepReport Bdf2FixedPoint::step(State& state, double h) {
  StepReport report;
  start_ = state;
  v_ = state.velocities;
  history_.begin(start_, h, solver_);
  solver_.copy_given(v_);
  solver_.judge_by_load();
  if (!iterate(state, report)) refuse(h);
  keep_angular_momentum(solver_.stage().base, solver_.world().frames(), state);
  history_.keep(start_, h, state);
  report.time = state.time;
  return report;
}

bool Bdf2FixedPoint::iterate(State& state, StepReport& report) {
  anderson_.begin();
  double mixing = 1.0;
  double now = solver_.residual(state, v_);
  // The impulse of the forces at the guess: no linearised step, which may lead far off, goes before it.
  const double first = std::max({solver_.acting(), now, 1e-300});
  while (true) {
    report.residual = now / first;
    report.converged = report.residual <= settings_.tolerance;
    if (report.converged || report.solver_iterations == settings_.iterations) break;
    if (!(now < kHopeless * first)) break;
    stop_if_asked();
    std::ranges::copy(solver_.right(), change_.begin());
    solver_.world().mass().divide(solver_.stage().base, change_);
    anderson_.advance(v_, change_, mixing, weight_);
    const double next = solver_.residual(state, v_);
    // Accelerated beyond its limit, the iteration may take less of each change than grows.
    if (settings_.anderson > 0 && !(next < now)) mixing = std::max(0.5 * mixing, kLeast);
    now = next;
    ++report.solver_iterations;
  }
  if (!report.converged) report.message = "the fixed-point iteration stopped before its tolerance";
  return report.converged || now < first;
}

void Bdf2FixedPoint::refuse(double h) const {
  const Vibration fastest = fastest_vibration(solver_.world(), start_);
  const double omega = fastest.frequency;
  const double damping = fastest.largest_damping;
  // A first step, of backward Euler, contracts while h^2 omega^2 + h c < 1.
  const double limit = 2.0 / (damping + std::sqrt(damping * damping + 4.0 * omega * omega));
  throw Error("the fixed-point iteration of the step from t = " + number_text(start_.time) +
              " s with dt = " + number_text(h) + " s does not contract: h^2 omega^2 is " +
              number_text(h * h * omega * omega) + " and h c is " + number_text(h * damping) +
              ", where without damping 9/4 is the limit; take dt below " + number_text(limit) +
              " s, Anderson's acceleration, or bdf2.");
}

}  // namespace tissu
