#include "tissu/step/bdf2.h"

namespace tissu {

void Bdf2::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  solver_.prepare(world, solver, profile);
  history_.prepare(world);
  start_ = world.rest_state();
  v_ = start_.velocities;
}

StepReport Bdf2::step(State& state, double h) {
  StepReport report;
  start_ = state;
  v_ = state.velocities;
  history_.begin(start_, h, solver_);
  solver_.solve(state, v_, report);
  keep_angular_momentum(solver_.stage().base, solver_.world().frames(), state);
  history_.keep(start_, h, state);
  report.time = state.time;
  return report;
}

}  // namespace tissu
