#include "tissu/step/bdf2.h"

#include <algorithm>
#include <utility>

#include "tissu/contact/contact.h"

namespace tissu {
namespace {

constexpr double kTurn = 1e-3;  ///< [rad] in a step: rotations that are extrapolated farther gain energy

/// A free rigid body turns so fast that its rotation cannot go on from the step before.
bool is_turning(const World& world, const State& state, double h) {
  if (world.contact() == nullptr) return false;
  return std::ranges::any_of(world.contact()->surfaces().carriers(), [&](const SurfaceCarrier& carrier) {
    return h * block(ConstReals(state.velocities), carrier.rotation).norm() > kTurn;
  });
}

}  // namespace

void Bdf2::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  solver_.prepare(world, solver, profile);
  history_.prepare(world);
  start_ = world.rest_state();
  v_ = start_.velocities;
}

void Bdf2::prepare_ahead(const State& state, double h) {
  history_.begin(state, h, solver_);
  solver_.prepare_ahead();
}

StepReport Bdf2::step(State& state, double h) {
  StepReport report;
  start_ = state;
  v_ = state.velocities;
  if (is_turning(solver_.world(), state, h)) history_.forget();
  history_.begin(start_, h, solver_);
  solver_.solve(state, v_, report);
  const bool struck = solver_.struck();
  if (struck && history_.goes_on()) solve_anew(state, h, report);
  history_.keep_momenta(solver_, state);
  keep_angular_momentum(solver_.stage().base, solver_.world().frames(), state);
  history_.keep(start_, h, state);
  if (struck) history_.forget();
  report.time = state.time;
  return report;
}

/// As backward Euler, without what went before.
void Bdf2::solve_anew(State& state, double h, StepReport& report) {
  StepReport anew;
  history_.forget();
  state = start_;
  v_ = state.velocities;
  history_.begin(start_, h, solver_);
  solver_.solve(state, v_, anew);
  anew.newton_iterations += report.newton_iterations;
  anew.solver_iterations += report.solver_iterations;
  anew.indefinite += report.indefinite;
  report = std::move(anew);
}

}  // namespace tissu
