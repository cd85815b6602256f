#include "tissu/step/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr int kPause = 63;       ///< iterations, at most, by a mean of matrices before an exact one is tried
constexpr double kLeast = 1e-3;  ///< share of the definite matrix in a mean
constexpr double kEaser = 0.25;  ///< times the share after a whole step
constexpr double kHarder = 4.0;  ///< times the share after …
constexpr double kCut = 0.2;     ///< … a step that was cut to so much
constexpr double kFarthest = 1e3;    ///< sizes of the scene, the mean of a correction: it has lost its way
constexpr int kPatience = 12;        ///< iterations that a whole step may take without a lower residual
constexpr double kRoundings = 16.0;  ///< roundings in a row of f, as of a matrix (solve/linear_solver.cpp)
constexpr double kStands = 0.5;      ///< of the residual before: one that does not fall below it stands still
constexpr double kCorrection = 0.01;       ///< of the displacement, at most, for the last correction
constexpr double kArmijo = 1e-4;           ///< share of the fall that the slope promises
constexpr double kShortest = 1e-9;         ///< a step is not cut below this
constexpr double kEnergyRounding = 1e-13;  ///< of the energies, which round-off may add to their sum

double dot(ConstReals a, ConstReals b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

double distance(ConstReals a, ConstReals b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

}  // namespace

Equilibrium::Equilibrium(const World& world, LinearSolver* solver, Profile& profile, NewtonSettings newton)
    : system_(world, solver, profile), tangent_(system_), newton_(newton), rest_(world.rest_state()) {
  from_ = rest_;
  for (auto* v : {&change_, &right_, &work_, &way_, &reactions_}) v->assign(rest_.positions.size(), 0.0);
}

double Equilibrium::residual(const State& state) {
  system_.force(state, right_);
  reactions_ = right_;
  world().fixed().clear(right_);
  return norm(right_);
}

void Equilibrium::steady(double mass, double farthest) {
  tangent_.set_mass(mass);
  farthest_ = farthest;
}

void Equilibrium::shorten(double share, State& state) {
  for (std::size_t k = 0; k < work_.size(); ++k) work_[k] = share * change_[k];
  world().fixed().copy(change_, work_);
  move(from_, world().frames(), work_, 1.0, state);
}

void Equilibrium::cut(bool leads) {
  double largest = 0.0;
  for (const double c : change_) largest = std::max(largest, std::abs(c));
  flew_ = farthest_ > 0.0 && largest > farthest_;
  if (flew_) {
    for (double& c : change_) c *= farthest_ / largest;
  }
  if (!leads) return;
  for (std::size_t i = 0; i < way_.size(); ++i) change_[i] += way_[i];
}

void Equilibrium::begin(const LoadPath& path, const State& start) {
  from_ = start;
  path.load(1.0, from_);
  end_load_ = system_.external_force(from_, work_);
}

double Equilibrium::load(double share, const State& state) {
  const bool now = share == 1.0 || world().contact() != nullptr;
  const double external = now ? system_.external_force(state, work_) : end_load_;
  if (external > 0.0 && !world().fixed().moves(state)) return external;
  double sum = 0.0;
  for (std::size_t i = 0; i < right_.size(); ++i) {
    sum += (reactions_[i] - right_[i]) * (reactions_[i] - right_[i]);
  }
  return std::max(external, std::sqrt(sum));
}

double Equilibrium::energy(const State& state) {
  double sum = 0.0;
  for (const auto& model : world().forces()) sum += model->energy(state, system_.scratch());
  return sum;
}

bool Equilibrium::is_reached(double share, const State& state, double now, std::optional<double> correction,
                             StepReport& report) {
  const double load = this->load(share, state);
  const double before = std::exchange(previous_, now);
  at_round_off_ = false;
  report.residual = load > 0.0 ? now / load : 0.0;
  if (!(now <= newton_.tolerance * load)) {
    if (now > 0.0 && !correction) system_.assemble(state, 0.0, {-1.0, 0.0});
    const double floor = system_.round_off(state);
    const bool stands = correction && now > kStands * before;
    if (now > (stands ? kRoundings : 1.0) * floor) return false;
    if (load <= kRoundings * floor) report.residual = 0.0;  // nothing acts
    at_round_off_ = report.residual > 0.0;
    return true;
  }
  if (world().is_linear() || !correction) return true;
  start_way_ = std::max(start_way_, distance(state.positions, rest_.positions));
  return *correction <= kCorrection * start_way_;
}

bool Equilibrium::solve(const State& state, StepReport& report) {
  is_exact_ = is_in_vain_ = false;
  if (pause_ > 0) {
    --pause_;
    ++report.indefinite;
    solve_mean(state, report);
  } else {
    const SolveReport solved = tangent_.solve(state, right_, change_);
    report.solver_iterations += solved.iterations;
    was_indefinite_ = !solved.positive_definite;
    if (was_indefinite_) {
      ++report.indefinite;
      is_exact_ = solved.converged;
      is_in_vain_ = !is_exact_;
      if (is_in_vain_) solve_mean(state, report);
    } else {
      share_ = 0.0;
      linear_solved_ = linear_solved_ && solved.converged;
    }
    world().fixed().clear(change_);
  }
  ++report.newton_iterations;
  return std::ranges::all_of(change_, [](double c) { return std::isfinite(c); });
}

void Equilibrium::solve_mean(const State& state, StepReport& report) {
  if (share_ == 0.0) share_ = 1.0;
  const SolveReport solved = tangent_.solve_mean(state, right_, change_, share_);
  report.solver_iterations += solved.iterations;
  linear_solved_ = linear_solved_ && solved.converged;
  world().fixed().clear(change_);
}

bool Equilibrium::is_unstable(const State& state) {
  if (!was_indefinite_) return false;
  residual(state);
  return tangent_.is_indefinite(state, right_, change_);
}

void Equilibrium::lead(const LoadPath& path, double before, double share, State& state, StepReport& report) {
  path.set_way(before, share, state, way_);
  if (std::ranges::all_of(way_, [](double w) { return w == 0.0; })) return;
  residual(state);
  system_.add_product(state, {1.0, 0.0}, way_, right_);
  world().fixed().clear(right_);
  from_ = state;
  solve(state, report);
  cut(true);
  go(state, 1.0);
}

bool Equilibrium::is_too_far() const {
  const double size = world().extent() * std::sqrt(static_cast<double>(rest_.blocks()));
  return size > 0.0 && correction_.value_or(0.0) > kFarthest * size;
}

double Equilibrium::go(State& state, double length) {
  for (std::size_t k = 0; k < work_.size(); ++k) work_[k] = length * change_[k];
  move(from_, world().frames(), work_, 1.0, state);
  return residual(state);
}

bool Equilibrium::halve(State& state, double& now) {
  from_ = state;
  const double next = go(state, 1.0);
  if (next < kStands * now) {
    now = next;
    correction_ = norm(change_);
    next_pause_ /= 2;
    return true;
  }
  state = from_;
  now = residual(state);
  return false;
}

bool Equilibrium::descend(State& state, double& now) {
  from_ = state;
  const double slope = -dot(right_, change_);
  const double before = energy(state);
  double size = 0.0;
  for (const auto& model : world().forces()) size += std::abs(model->energy(state, system_.scratch()));
  for (double length = 1.0; length > kShortest; length *= 0.5) {
    const double next = go(state, length);
    if (!std::isfinite(next)) continue;
    const double fall = energy(state) - before;
    const double after = -dot(right_, change_);
    const bool falls = fall <= kArmijo * length * slope;
    // Close to the solution the fall is lost in the energy's round-off; its slope is not.
    const bool flat = std::abs(fall) <= kEnergyRounding * size && std::abs(after) <= 0.9 * std::abs(slope);
    if (!falls && !flat) continue;
    now = next;
    correction_ = length * norm(change_);
    if (share_ > 0.0) {
      share_ *= length == 1.0 ? kEaser : length < kCut ? kHarder : 1.0;
      share_ = std::clamp(share_, kLeast, 1.0);
    }
    return true;
  }
  state = from_;
  now = residual(state);
  return false;
}

bool Equilibrium::search_energy(State& state, double& now, StepReport& report) {
  if (is_exact_ && halve(state, now)) return true;
  if (is_in_vain_ || is_exact_) pause_ = next_pause_ = std::min(2 * next_pause_ + 1, kPause);
  if (is_exact_ || !(dot(right_, change_) > 0.0)) solve_mean(state, report);
  if (descend(state, now)) return true;
  if (share_ == 1.0) return false;
  share_ = 1.0;
  solve_mean(state, report);
  return descend(state, now);
}

Equilibrium::End Equilibrium::find(const LoadPath& path, double before, double share, Search search, int most,
                                   State& state, StepReport& report) {
  path.load(share, state);
  correction_.reset();
  linear_solved_ = true;
  flew_ = false;
  pause_ = next_pause_ = 0;
  share_ = 0.0;
  start_way_ = distance(state.positions, rest_.positions);
  const int first = report.newton_iterations;
  const auto stop = [&](End end) { return linear_solved_ ? end : End::solver; };
  lead(path, before, share, state, report);
  double now = residual(state);
  Progress progress{now};
  while (true) {
    if (!std::isfinite(now)) return stop(End::ran_away);
    stop_if_asked();
    if (flew_) return End::flew;
    if (is_reached(share, state, now, correction_, report)) return End::reached;
    if (is_too_far() || progress.idle > kPatience) return stop(End::ran_away);
    if (report.newton_iterations - first >= most) return stop(End::most);
    if (!solve(state, report)) return stop(End::ran_away);
    if (farthest_ > 0.0) cut(false);
    if (flew_) search = Search::none;
    if (search == Search::energy) {
      if (!search_energy(state, now, report)) return stop(End::no_descent);
      continue;
    }
    from_ = state;
    now = go(state, 1.0);
    correction_ = norm(change_);
    ++progress.idle;
    if (now < progress.lowest) progress = {now};
  }
}

}  // namespace tissu
