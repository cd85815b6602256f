#include "tissu/step/implicit_euler.h"

namespace tissu {

void ImplicitEuler::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  solver_.prepare(world, solver, profile);
  start_ = world.rest_state();
  v_ = start_.velocities;
}

void ImplicitEuler::begin(const State& state, double h) {
  start_ = state;
  v_ = state.velocities;
  // Loads and led nodes act with their value at the end of the step.
  solver_.begin(start_, state.time + h, h);
  solver_.lead(start_, state.time + h, h, 1.0);
}

void ImplicitEuler::prepare_ahead(const State& state, double h) {
  begin(state, h);
  solver_.prepare_ahead();
}

StepReport ImplicitEuler::step(State& state, double h) {
  StepReport report;
  begin(state, h);
  solver_.solve(state, v_, report);
  keep_angular_momentum(start_, solver_.world().frames(), state);
  report.time = state.time;
  return report;
}

}  // namespace tissu
