#include "tissu/step/explicit_method.h"

#include <cmath>
#include <limits>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/state/free_turn.h"

namespace tissu {
namespace {

/// Steps that differ by no more than this share are the same.
constexpr double kSame = 1e-9;

}  // namespace

void ExplicitMethod::prepare(const World& world, LinearSolver* /*solver*/, Profile& profile) {
  system_ = std::make_unique<System>(world, nullptr, profile);
  start_ = world.rest_state();
  stable_.prepare(world, profile);
  contact_.reset();
  if (world.contact() != nullptr) prepare_touching(world, profile);
}

double ExplicitMethod::stable_step(const State& state) {
  stable_.limit(amplification(), state);
  return stable_.lasting();
}

StepReport ExplicitMethod::step(State& state, double h) {
  const double limit = stable_.limit(amplification(), state);
  if (h > limit * (1.0 + kSame)) {
    const Amplification method = amplification();
    std::string message = "the step is " + number_text(h) + " s at t = " + number_text(state.time) + " s; " +
                          std::string(name()) + " is stable up to " + number_text(limit) +
                          " s here (2 / omega is " + number_text(2.0 / largest_frequency(world(), state)) +
                          " s)";
    if (method.growth > 0.0)
      message += ", counting as stable what takes a hundred seconds to grow by a factor e";
    throw ParameterError(message +
                         (is_part_ ? "." : "; take dt: auto, a smaller dt, or an implicit method."));
  }
  if (!is_part_) stable_.take(h);
  StepReport report;
  start_ = state;
  state.time = start_.time + h;
  if (contact_ != nullptr) begin_touching(h);
  advance(state, h);
  if (contact_ != nullptr) {
    require_bearable(h, limit);
    report.contacts = static_cast<int>(contact_->size());
    report.held_back = held_back_;
    report.least_gap = contact_->least_gap();
  }
  carry_angular_momentum(start_, world().frames(), state);
  report.time = state.time;
  report.converged = true;
  if (contact_ != nullptr) tell_depth(report);
  if (stable_.may_invert(start_, state) && !has_energy(state))
    report.residual = std::numeric_limits<double>::quiet_NaN();
  return report;
}

bool ExplicitMethod::has_energy(const State& state) {
  double energy = 0.0;
  for (const Body& body : world().bodies()) {
    for (const BodyModel* model : body.models) energy += model->energy(state, scratch_);
  }
  return std::isfinite(energy);
}

void ExplicitMethod::acceleration(const State& state, double share, Reals a) {
  system_->force(state, a);
  if (contact_ != nullptr) push(state, share, a);
  world().mass().divide(start_, a);
  world().fixed().clear(a);
}

void ExplicitMethod::go(ConstReals way, double pushed, double h, State& state) {
  if (contact_ != nullptr) {
    touch(way, pushed, h, state);
    return;
  }
  place(way, h, state);
}

void ExplicitMethod::place(ConstReals way, double h, State& state) {
  if (turns_freely()) {
    move_freely(start_, world().frames(), world().fixed().masks(), way, h, state);
  } else {
    move(start_, world().frames(), way, h, state);
  }
  lead(state, h);
}

void ExplicitMethod::lead(State& state, double since) const {
  const FixedDofs& fixed = world().fixed();
  if (fixed.empty()) return;
  fixed.set_velocities(start_, state.time, since, 1.0, state.velocities);
  fixed.place(start_, since, state.velocities, state);
}

}  // namespace tissu
