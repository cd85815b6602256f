/// Steps in which contact has a potential: Newton's iteration along which the energy falls, on ways that lead
/// through nothing (after Li et al. 2020, ACM Transactions on Graphics 39(4), Incremental potential contact).

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"
#include "tissu/step/stage.h"

namespace tissu {
namespace {

constexpr int kMost = 100;        ///< of Newton's iterations of one lag, where none are given
constexpr int kMostLags = 10;     ///< of friction's normal forces
constexpr double kLagged = 1e-2;  ///< a smaller change of them needs no other lag
constexpr double kKept = 0.9;     ///< of a way that is free
constexpr double kShortest = 1e-12;
constexpr double kArmijo = 1e-4;     ///< share of the fall that the slope promises
constexpr double kRoundings = 16.0;  ///< in each row of the residual
constexpr double kClose = 1e-6;      ///< of the energies: what round-off and the turning of friction may add
constexpr double kFalls = 0.9;       ///< of the slope before, where that hides the fall

}  // namespace

int StageSolver::stand(State& state, std::vector<double>& v) {
  place(state, v);
  way_end_ = end_of(state);
  way_end_.positions = step_start_->positions;
  way_end_.rotations = step_start_->rotations;
  contact_->run().stand(way_end_);
  hold_back(way_end_);
  trial_ = v;
  const double move = stage_.contact.stretch * stage_.move;
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = (way_end_.positions[i] - stage_.base.positions[i]) / move;
  }
  for (const Frame& frame : system_->world().frames()) block(Reals(v), frame.rotation).setZero();
  system_->world().fixed().copy(trial_, v);
  // What is held or led along some of its axes alone pushes nothing ahead, and may be in the way.
  place(state, v);
  State& end = end_of(state);
  const int rows = hold_back(end);
  follow(end, v);
  return rows;
}

double StageSolver::potential(BarrierContact& barrier, State& state, ConstReals v) {
  system_->world().contact()->numbers(state).clear();
  const double without = potential(state, v);
  look(end_of(state));
  return without + stage_.push / stage_.move * barrier.energy();
}

/// Rotations of a part of a change of velocities are not quite those of a part of the way.
bool StageSolver::is_cut(State& state) {
  place(state, trial_);
  way_end_ = end_of(state);
  return hold_back(way_end_) > 0;
}

bool StageSolver::search_barrier(BarrierContact& barrier, double from, State& state, std::vector<double>& v) {
  const double slope = -std::inner_product(right_.begin(), right_.end(), change_.begin(), 0.0);
  const DampingWork damping = damping_work(state);
  go(v, 1.0);
  place(state, trial_);
  way_end_ = end_of(state);
  double share = hold_back(way_end_) > 0 ? kKept * contact_->run().least_share() : 1.0;
  const bool turns = share < 1.0 && system_->world().contact()->surfaces().has_turning_riders();
  for (; share > kShortest; share *= 0.5) {
    go(v, share);
    if (turns && is_cut(state)) continue;
    const double to = potential(barrier, state, trial_) + damping.at(share);
    bool falls = to <= from + kArmijo * share * slope;
    if (!falls && std::abs(to - from) <= kClose * (std::abs(to) + std::abs(from))) {
      contact_->take();
      set_contacts(state);
      residual(state, trial_);
      const double after = -std::inner_product(right_.begin(), right_.end(), change_.begin(), 0.0);
      falls = std::abs(after) <= kFalls * std::abs(slope);
    }
    if (!falls) continue;
    std::swap(v, trial_);
    return true;
  }
  return false;
}

std::string_view StageSolver::descend_barrier(BarrierContact& barrier, State& state, std::vector<double>& v,
                                              StepReport& report) {
  const int most = newton_.iterations > 1 ? newton_.iterations : kMost;
  for (int i = 0;; ++i) {
    const double energy = potential(barrier, state, v);
    contact_->take();
    set_contacts(state);
    const double now = residual(state, v);
    report.residual = acting_ > 0.0 || !std::isfinite(now) ? now / acting_ : 0.0;
    if (now <= newton_.tolerance * acting_) return {};
    if (!std::isfinite(now)) return "Newton's iteration ran away";
    if (i == most) return "Newton's iteration stopped before its tolerance";
    assemble(state, true);
    if (now <= kRoundings * system_->round_off(state) / stage_.move) return {};
    stop_if_asked();
    std::ranges::fill(change_, 0.0);
    solve_linear(state, 0.0, true, report);
    ++report.newton_iterations;
    contact_->run().go_on_from(end_of(state));
    if (!search_barrier(barrier, energy, state, v)) return "the energy could not be lowered further";
  }
}

void StageSolver::solve_barrier(BarrierContact& barrier, State& state, std::vector<double>& v,
                                StepReport& report) {
  report.held_back = stand(state, v);
  for (int lag = 1; report.held_back == 0; ++lag) {
    report.message = descend_barrier(barrier, state, v, report);
    place(state, v);
    look(end_of(state));
    contact_->take();
    if (barrier.lag() <= kLagged || !report.message.empty()) break;
    if (lag == kMostLags) {
      report.message = "friction had not come to rest after " + std::to_string(lag) + " lags";
      break;
    }
  }
  if (report.held_back > 0) {
    look(end_of(state));
    contact_->take();
  }
  report.converged = report.message.empty() && report.held_back == 0;
  report.hasty = !report.converged;
  std::ranges::copy(v, state.velocities.begin());
  contact_->finish(end_of(state), state);
  report.contacts = static_cast<int>(contact_->size());
  report.least_gap = contact_->least_gap();
}

}  // namespace tissu
