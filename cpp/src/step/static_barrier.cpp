#include "tissu/step/static_barrier.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tissu/base/interruption.h"
#include "tissu/contact/barrier.h"

namespace tissu {
namespace {

constexpr int kMostFlights = 40;  ///< corrections that were cut since they went out of the scene
constexpr double kKept = 0.9;     ///< of a way that is free
constexpr double kShortest = 1e-12;
constexpr double kArmijo = 1e-4;     ///< share of the fall that the slope promises
constexpr double kClose = 1e-6;      ///< of the energies: what round-off and the turning of friction may add
constexpr double kFalls = 0.9;       ///< of the slope before, where that hides the fall
constexpr double kHalf = 0.5;        ///< of the residual: what leaves no more is a step on, too
constexpr double kLeastMean = 1e-3;  ///< share of the definite matrix in a mean
constexpr double kEaser = 0.25;      ///< times the share after a whole step
constexpr double kHarder = 4.0;      ///< times the share after …
constexpr double kCut = 0.2;         ///< … a step that was cut to so much

double dot(ConstReals a, ConstReals b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

}  // namespace

StaticBarrier::StaticBarrier(Equilibrium& equilibrium, Profile& profile)
    : StaticContact(equilibrium, profile, ContactMethod::barrier),
      barrier_(*contact_->barrier()),
      trial_(start_),
      change_(start_.positions.size()),
      work_(start_.positions.size()) {}

bool StaticBarrier::stand(const LoadPath& path, double to, State& state) {
  state = held_;
  path.load(to, state);
  contact_->run().stand(state);
  // What is held or led along some of its axes alone stays on them, and pushes nothing ahead.
  world().fixed().copy(held_.positions, state.positions);
  trial_ = state;
  return hold_back(trial_) == 0;
}

void StaticBarrier::refresh(State& state) {
  for (int lag = 0; lag < 2; ++lag) {
    look(state);
    contact_->take();
    if (lag == 0) barrier_.lag();
  }
  contact_->write(state);
}

double StaticBarrier::energy(State& state) {
  world().contact()->numbers(state).clear();
  const double without = equilibrium_.energy(state);
  look(state);
  return without + barrier_.energy();
}

void StaticBarrier::solve(const State& state, StepReport& report) {
  TangentSolve& tangent = equilibrium_.tangent();
  const ConstReals right = equilibrium_.right();
  ++report.newton_iterations;
  SolveReport solved;
  bool falls = false;
  if (mean_ == 0.0) {
    solved = tangent.solve(state, right, change_);
    report.solver_iterations += solved.iterations;
    falls = solved.positive_definite;
  }
  if (!falls || !(dot(right, change_) > 0.0)) {
    ++report.indefinite;
    if (mean_ == 0.0) mean_ = 1.0;
    report.solver_iterations += tangent.solve_mean(state, right, change_, mean_).iterations;
  }
  world().fixed().clear(change_);
  double largest = 0.0;
  for (const double c : change_) largest = std::max(largest, std::abs(c));
  flew_ = farthest_ > 0.0 && largest > farthest_;
  if (flew_) {
    for (double& c : change_) c *= farthest_ / largest;
  }
}

bool StaticBarrier::is_lower(double from, double share, double slope, double now, State& state) {
  const double to = energy(trial_);
  if (to <= from + kArmijo * share * slope) return true;
  if (!std::isfinite(to)) return false;
  // Friction turns with the surfaces, which no potential has; close to the end round-off hides the fall.
  contact_->take();
  contact_->write(trial_);
  const double left = equilibrium_.residual(trial_);
  const double after = dot(equilibrium_.right(), change_);
  const bool close = std::abs(to - from) <= kClose * (std::abs(to) + std::abs(from));
  if (left <= kHalf * now || (close && left < now && std::abs(after) <= kFalls * std::abs(slope))) {
    return true;
  }
  refresh(state);
  return false;
}

bool StaticBarrier::search(double now, State& state) {
  const double slope = -dot(equilibrium_.right(), change_);
  const double from = energy(state);
  refresh(state);
  const auto go = [&](double share) {
    for (std::size_t k = 0; k < work_.size(); ++k) work_[k] = share * change_[k];
    trial_ = state;
    move(state, world().frames(), work_, 1.0, trial_);
  };
  go(1.0);
  double share = hold_back(trial_) > 0 ? kKept * contact_->run().least_share() : 1.0;
  for (; share > kShortest; share *= 0.5) {
    go(share);
    if (is_lower(from, share, slope, now, state)) {
      if (mean_ > 0.0) {
        mean_ *= share == 1.0 ? kEaser : share < kCut ? kHarder : 1.0;
        mean_ = std::clamp(mean_, kLeastMean, 1.0);
      }
      state = trial_;
      return true;
    }
  }
  return false;
}

bool StaticBarrier::seek(const LoadPath& path, double from, double to, int most, State& state,
                         StepReport& report) {
  begin(path, from, to, state);
  if (!stand(path, to, state)) {
    return give_up(
        "what is held or led along one or two axes is in the way of something that is led; lead it less far, "
        "in more steps, or hold it along all three");
  }
  contact_->run().go_on_from(state);
  look(state);
  contact_->take();
  barrier_.go_on_from(world().contact()->table(start_));
  mean_ = 0.0;
  int flights = 0;
  const int first = report.newton_iterations;
  while (true) {
    stop_if_asked();
    contact_->run().go_on_from(state);
    refresh(state);
    if (barrier_.stiffen()) refresh(state);
    const double now = equilibrium_.residual(state);
    if (!std::isfinite(now)) return give_up("Newton's iteration ran away");
    if (equilibrium_.is_reached(to, state, now, 0.0, report)) break;
    if (report.newton_iterations - first >= most) return give_up("all of Newton's iterations were used");
    solve(state, report);
    if (flew_ && ++flights > kMostFlights) return give_up(moves_on());
    if (!search(now, state)) return give_up("the energy could not be lowered further");
  }
  contact_->finish(state, state);
  is_unstable_ = mean_ > 0.0 && equilibrium_.tangent().is_indefinite(state, equilibrium_.right(), change_);
  return true;
}

bool StaticBarrier::find_at_gap(const LoadPath& path, double share, int most, State& state,
                                StepReport& report) {
  barrier_.rest_at_gap(true);
  const bool was_unstable = is_unstable_;
  const bool found = find(path, share, share, most, state, report);
  barrier_.rest_at_gap(false);
  if (!found) is_unstable_ = was_unstable;
  return found;
}

}  // namespace tissu
