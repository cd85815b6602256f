/// Steps that are linearised once: what they may leave of their equation, and what is done where it is more.

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tissu/step/stage.h"

namespace tissu {
namespace {

constexpr double kFloor = 1e-3;  ///< of the external impulse: less is left by any linear solver
constexpr double kWorse = 2.0;   ///< times the residual of the guess
constexpr double kNear = 1e-2;   ///< of what acts: an iteration that was stopped there has improved the step
constexpr double kRoundings = 1e-9;  ///< of the sum of energies

}  // namespace

void StageSolver::balance_parts() {
  if (knows_parts_) return;
  balance_.prepare(world());
  rigid_.prepare(world(), balance_);
  ahead_.prepare(world(), balance_);
  is_viscous_ =
      std::ranges::any_of(world().forces(), [](const auto& model) { return model->may_drive_turns(); });
  turning_by_.assign(is_viscous_ ? turn_to_.size() : 0, 0.0);
  knows_parts_ = true;
}

void StageSolver::count_parts() {
  if (world().is_linear()) return;
  balance_parts();
  part_count_ = balance_.parts().size();
}

bool StageSolver::came_apart() {
  if (world().is_linear()) return true;
  balance_parts();
  return balance_.parts().size() > part_count_;
}

void StageSolver::turn_ahead(std::vector<double>& v) {
  turns_ = false;
  if (world().is_linear() || is_part_) return;  // after a blow, nothing goes on as it did
  balance_parts();
  turns_ = ahead_.lay({*step_start_, stage_.base, stage_.move, stage_.end, stage_.past}, given_, turned_,
                      turn_to_, v, turning_by_);
}

void StageSolver::set_straining(ConstReals v, State& state) const {
  state.straining.clear();
  if (!turns_ || !is_viscous_) return;
  state.straining.resize(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) state.straining[i] = v[i] - turning_by_[i];
}

bool StageSolver::correct_rigidly(State& state, std::vector<double>& v, double& left) {
  uncorrected_ = v;
  if (!rigid_.correct(state, stage_.push, stage_.move, right_, momentum_, v)) return false;
  left = residual(state, v);
  const int taken_back = rigid_.take_back(state, right_, uncorrected_, v);
  if (taken_back > 0) left = residual(state, v);
  return taken_back < rigid_.corrected();
}

bool StageSolver::leaves_much(const State& state) {
  if (!balance_.leaves_more(most_left_, 0.0, right_, momentum_)) return false;
  if (world().fixed().moves(*step_start_)) {
    look_at_reactions();
    if (!balance_.leaves_more(most_left_, 0.0, right_, momentum_)) return false;
  }
  std::ranges::copy(right_, trial_.begin());
  system_->add_product(state, {0.0, -stage_.push}, state.strains_by(), trial_);
  system_->add_product(linearised_at(), {0.0, stage_.push}, state.strains_by(), trial_);
  world().fixed().clear(trial_);
  const double floor = system_->round_off(stage_.base) / stage_.move;
  return balance_.leaves_more(most_left_, floor, trial_, momentum_);
}

void StageSolver::look_at_reactions() {
  balance_.lay_strained(given_, trial_);
  std::ranges::fill(work_, 0.0);
  system_->add_product(linearised_at(), {stage_.move * stage_.push, 0.0}, trial_, work_);
  system_->force(*step_start_, trial_);
  for (double& r : trial_) r *= stage_.push;
  balance_.set_reactions(trial_, work_);
}

StageSolver::Judged StageSolver::judge_linearised(State& state, std::vector<double>& v, StepReport& report) {
  if (world().is_linear()) {
    place(state, v);
    return Judged::kept;
  }
  double left = residual(state, v);
  const Judged judged = correct_rigidly(state, v, left) ? Judged::corrected : Judged::kept;
  const bool no_worse = left <= kWorse * start_ + kFloor * reference_;
  if (no_worse ? !leaves_much(state) : gives_up_early_ && turns_far(v)) return judged;
  if (!no_worse && contact_ != nullptr && contact_->size() > 0) {
    report.hasty = true;  // a blow: it is taken in parts
    return judged;
  }
  const StepReport once = report;
  once_ = v;
  const bool solved = rescue(state, v, report);
  report.newton_iterations += once.newton_iterations - 1;
  if (solved || !no_worse) {
    left = residual(state, v);
    correct_rigidly(state, v, left);
    return Judged::iterated;
  }
  v = once_;
  place(state, v);
  if (gains_energy(state)) return judged;
  report.converged = once.converged;
  report.residual = once.residual;
  report.message = once.message;
  report.hasty = false;
  return judged;
}

bool StageSolver::is_near(std::string_view why, const StepReport& report) {
  return why.empty() || report.residual <= kNear;
}

bool StageSolver::rescue(State& state, std::vector<double>& v, StepReport& report) {
  bool solved = is_near(iterate(state, v, Search::none, kRescue, report), report) && is_lower(state, v);
  report.message.clear();
  if (!solved) {
    v = guess_;
    world().fixed().copy(once_, v);
    report.message = iterate(state, v, Search::energy, kRescue, report);
    solved = is_near(report.message, report);
    if (solved) report.message.clear();
  }
  report.converged = solved;
  report.hasty = !solved;
  return solved;
}

bool StageSolver::gains_energy(const State& state) {
  const auto& forces = world().forces();
  if (world().fixed().moves()) return false;
  if (std::ranges::any_of(forces, [](const auto& model) { return model->may_add_energy(); })) return false;
  double size = 0.0;
  const auto energy = [&](const State& at) {
    double sum = world().mass().kinetic_energy(at);
    size += sum;
    for (const auto& model : forces) {
      const double stored = model->energy(at, scratch_);
      sum += stored;
      size += std::abs(stored);
    }
    return sum;
  };
  return energy(state) - energy(*step_start_) > kRoundings * size;
}

}  // namespace tissu
