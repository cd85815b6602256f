/// Steps of a world with contact (Alart and Curnier 1991). What is elastic is linearised once; contacts are
/// looked at again after each system, which differs from the one before in couplings alone.

#include <algorithm>
#include <string>

#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"
#include "tissu/step/stage.h"

namespace tissu {
namespace {

constexpr double kFloor = 1e-3;      ///< of the external impulse: a smaller right-hand side is judged by it
constexpr double kDepth = 1e-2;      ///< of the gap: contacts no deeper than this need no other system
constexpr int kLater = 8;            ///< after so many systems …
constexpr double kLaterDepth = 0.1;  ///< … this is deep enough: the next step goes on from its forces
constexpr double kTooDeep = 0.5;
constexpr double kDepthNewton = 1e-3;
constexpr double kForce = 1e-2;  ///< of the contacts' forces: a smaller change needs no other system
constexpr double kForceNewton = 1e-3;
constexpr int kMostLooks = 20;  ///< of a step whose equation is solved to its tolerance
constexpr double kWorse = 2.0;

std::string unsettled(int systems) {
  return "contacts had not settled after " + std::to_string(systems) +
         (systems == 1 ? " system" : " systems") +
         ": more than a hundredth of their forces pull or exceed friction, or they are deeper than half "
         "the gap; take a smaller dt or more iterations of contact";
}

}  // namespace

double StageSolver::look(const State& at) {
  const Timed timed(*profile_, detection_row_);
  return contact_->look(at);
}

int StageSolver::hold_back(State& to) {
  const Timed timed(*profile_, travel_row_);
  return contact_->hold_back(to);
}

void StageSolver::update_contacts(const State& end) {
  const Timed timed(*profile_, response_row_);
  contact_->update(end);
}

/// v takes what is given, and what is led goes ahead.
void StageSolver::begin_touching(State& state, std::vector<double>& v) {
  const World& world = system_->world();
  state.memory = stage_.base.memory;
  std::ranges::copy(v, trial_.begin());
  world.fixed().copy(given_, trial_);
  place(state, trial_);
  {
    const Timed timed(*profile_, detection_row_);
    // work_ is the external force, as judge_by_load left it.
    contact_->begin(*step_start_, stage_.base.time, state.positions, work_);
  }
  world.contact()->numbers(stage_.base).clear();
  lay_right(v);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += first_[i];
  elastic_ = right_;
  assemble(stage_.base, false);
  blocks_.resize(3 * v.size());
  system_->system_matrix().diagonal_blocks(blocks_);
  contact_->set_matrix(blocks_, stage_.move * stage_.push);
}

void StageSolver::set_contacts(State& state) {
  contact_->write(state);
  contact_->write(stage_.base);
}

void StageSolver::follow(const State& state, std::vector<double>& v) const {
  const std::vector<std::uint8_t>& masks = system_->world().fixed().masks();
  std::vector<std::uint8_t> turns(masks.size(), 0);
  for (const Frame& frame : system_->world().frames()) turns[static_cast<std::size_t>(frame.rotation)] = 1;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (turns[i / 3] != 0) continue;
    const double moved = stage_.base.positions[i] + stage_.move * v[i];
    if (moved != state.positions[i]) v[i] = (state.positions[i] - stage_.base.positions[i]) / stage_.move;
  }
}

bool StageSolver::solve_contacts(State& state, std::vector<double>& v, StepReport& report) {
  const World& world = system_->world();
  const Contact& contact = *world.contact();
  const int most = contact.description().iterations;
  place(state, v);
  hold_back(state);
  look(state);
  contact_->take();
  bool solved = true;
  for (int i = 1;; ++i) {
    set_contacts(state);
    place(state, v);
    std::ranges::fill(work_, 0.0);
    {
      const Timed timed(*profile_, response_row_);
      contact.add_force(state, scratch_, work_);
    }
    for (std::size_t k = 0; k < work_.size(); ++k) right_[k] = elastic_[k] + stage_.push * work_[k];
    world.fixed().clear(right_);
    system_->recouple(stage_.base);
    std::ranges::fill(change_, 0.0);
    const SolveReport found = solve_linear(stage_.base, kFloor * reference_, false, report);
    solved = solved && found.converged;
    ++report.newton_iterations;
    report.residual = found.residual;
    // Without contact: A change - C change.
    system_->system_matrix().multiply(change_, work_);
    contact.add_product(stage_.base, scratch_, {stage_.move * stage_.push, 0.0}, change_, work_);
    for (std::size_t k = 0; k < v.size(); ++k) {
      elastic_[k] -= work_[k];
      v[k] += change_[k];
    }
    world.fixed().clear(elastic_);
    place(state, v);
    update_contacts(state);
    report.held_back = hold_back(state);
    const double other = look(state);
    const bool free = report.held_back == 0;
    if (free && other <= kForce && contact_->depth() <= (i < kLater ? kDepth : kLaterDepth)) break;
    if (i == most) {
      report.hasty = contact_->inadmissible() > kForce || contact_->depth() > kTooDeep;
      if (report.hasty) report.message = unsettled(most);
      break;
    }
    contact_->take();
    stop_if_asked();
  }
  return solved && !report.hasty;
}

/// Newton's iteration with the contacts of one look, and looks until they stay.
void StageSolver::iterate_contacts(State& state, std::vector<double>& v, StepReport& report) {
  const World& world = system_->world();
  const int most = newton_.iterations;
  int iterations = report.newton_iterations;
  for (int i = 0; i < kMostLooks; ++i) {
    look(state);
    contact_->take();
    set_contacts(state);
    first_ = v;
    std::string_view why = iterate(state, v, Search::none, most, report);
    if (!why.empty() && !is_falling_) {
      v = first_;
      iterations += report.newton_iterations;
      why = iterate(state, v, Search::energy, most, report);
    }
    iterations += report.newton_iterations;
    report.message = why;
    place(state, v);
    update_contacts(state);
    report.held_back = hold_back(state);
    if (report.held_back > 0) follow(state, v);
    const double other = look(state);
    if (other <= kForceNewton && report.held_back == 0 && contact_->depth() <= kDepthNewton) break;
    if (i + 1 == kMostLooks) {
      report.converged = false;
      report.message = "contacts had not come to rest after " + std::to_string(kMostLooks) + " looks";
    }
  }
  report.newton_iterations = iterations;
  std::ranges::copy(v, state.velocities.begin());
  world.fixed().clear(first_);
}

void StageSolver::solve_touching(State& state, std::vector<double>& v, StepReport& report) {
  begin_touching(state, v);
  report.converged = solve_contacts(state, v, report);
  if (!report.converged && !report.hasty) report.message = "the linear solver stopped before its tolerance";
  if (report.held_back > 0) follow(state, v);
  std::ranges::copy(v, state.velocities.begin());
  contact_->finish(state);
  if (newton_.iterations > 1) {
    iterate_contacts(state, v, report);
    contact_->finish(state);
  } else if (report.held_back == 0 && !system_->world().is_linear()) {
    report.hasty = report.hasty || !(residual(state, v) <= kWorse * start_ + kFloor * reference_);
  }
  report.contacts = static_cast<int>(contact_->size());
  report.least_gap = contact_->least_gap();
}

}  // namespace tissu
