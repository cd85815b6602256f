#include "tissu/step/newmark.h"

#include "tissu/base/error.h"

namespace tissu {

Newmark::Newmark(Settings settings)
    : beta_(settings.beta), gamma_(settings.gamma), solver_(settings.newton, {.held = 0.1, .free = 0.1}) {
  if (!(beta_ > 0.0 && beta_ <= 0.5 && gamma_ >= 0.5 && gamma_ <= 1.0 && 2.0 * beta_ >= gamma_)) {
    throw ParameterError(
        "Newmark's method needs 0.5 <= gamma <= 1 and gamma / 2 <= beta <= 0.5: others are unstable for "
        "large "
        "steps.");
  }
}

void Newmark::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  solver_.prepare(world, solver, profile);
  start_ = world.rest_state();
  v_ = start_.velocities;
  a_ = start_.velocities;
  end_.forget();
}

void Newmark::find_acceleration(const State& state) {
  if (end_.is(state)) return;
  // It leaves out the contacts of the step before.
  solver_.system().force(state, a_);
  if (const Contact* contact = solver_.world().contact()) contact->take_force(state, a_);
  solver_.world().mass().divide(state, a_);
}

StepReport Newmark::step(State& state, double h) {
  StepReport report;
  start_ = state;
  find_acceleration(start_);
  const double ratio = beta_ / gamma_;
  solver_.begin(start_, start_.time + h, h);
  Stage& stage = solver_.stage();
  stage.push = gamma_ * h;
  stage.move = ratio * h;
  stage.contact.times = 1.0 / beta_;
  const double by_velocity = (1.0 - ratio) * h;
  const double by_acceleration = (0.5 - beta_ - ratio * (1.0 - gamma_)) * h * h;
  stage.past = {.velocity = by_velocity, .acceleration = by_acceleration};
  for (std::size_t i = 0; i < a_.size(); ++i) {
    v_[i] = by_velocity * start_.velocities[i] + by_acceleration * a_[i];
    stage.base.velocities[i] = start_.velocities[i] + (1.0 - gamma_) * h * a_[i];
  }
  tissu::move(start_, solver_.world().frames(), v_, 1.0, stage.base);
  keep_angular_momentum(start_, solver_.world().frames(), stage.base);
  solver_.lead(start_, start_.time + h, h, 1.0);
  v_ = state.velocities;
  solver_.solve(state, v_, report);
  solver_.add_contact_impulse(-h / ratio, v_);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    a_[i] = (v_[i] - stage.base.velocities[i]) / (gamma_ * h);
  }
  solver_.add_contact_impulse(h - h / ratio, state.velocities);
  solver_.end_touching(h, state);
  keep_angular_momentum(stage.base, solver_.world().frames(), state);
  report.time = state.time;
  end_.set(state);
  if (report.held_back > 0) end_.forget();  // what was cut has no acceleration
  return report;
}

void Newmark::append_memory(std::vector<double>& memory) const {
  if (end_.is_empty()) return;
  end_.append_to(memory);
  memory.insert(memory.end(), a_.begin(), a_.end());
}

void Newmark::restore(ConstReals memory) {
  end_.forget();
  if (memory.empty()) return;
  require_memory(memory.size(), 1 + 3 * a_.size());
  const ConstReals a = end_.take_from(memory, a_.size());
  a_.assign(a.begin(), a.end());
}

void Newmark::copy_rows(std::span<const RowCopy> copies) {
  if (end_.is_empty()) return;
  end_.copy_rows(copies);
  tissu::copy_rows(copies, a_);
}

void Newmark::blend_rows(std::span<const RowBlend> blends) {
  if (end_.is_empty()) return;
  end_.blend_rows(blends);
  tissu::blend_rows(blends, a_);
}

}  // namespace tissu
