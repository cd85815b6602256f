#include "tissu/step/implicit_midpoint.h"

namespace tissu {

void ImplicitMidpoint::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  solver_.prepare(world, solver, profile);
  start_ = world.rest_state();
  mean_ = start_.velocities;
}

void ImplicitMidpoint::begin(const State& state, double h) {
  start_ = state;
  mean_ = state.velocities;
  // Half a step of backward Euler; where motion is given, its mean velocity over the whole one.
  solver_.begin(start_, start_.time + 0.5 * h, 0.5 * h);
  solver_.stage().end = start_.time + h;
  solver_.stage().contact = {2.0, 2.0};
  solver_.lead(start_, start_.time + h, h, 0.5);
}

void ImplicitMidpoint::prepare_ahead(const State& state, double h) {
  begin(state, h);
  solver_.prepare_ahead();
}

StepReport ImplicitMidpoint::step(State& state, double h) {
  StepReport report;
  begin(state, h);
  solver_.solve(state, mean_, report);
  // The other half goes on with the same velocity.
  move(start_, solver_.world().frames(), mean_, h, state);
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    state.velocities[i] = 2.0 * mean_[i] - start_.velocities[i];
  }
  // The way has the whole impulse of contacts in it, so that twice the mean velocity has it twice.
  solver_.add_contact_impulse(-h, state.velocities);
  solver_.copy_given(state.velocities);
  solver_.end_touching(h, state);
  keep_angular_momentum(start_, solver_.world().frames(), state);
  state.time = start_.time + h;
  report.time = state.time;
  return report;
}

}  // namespace tissu
