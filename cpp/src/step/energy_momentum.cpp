#include "tissu/step/energy_momentum.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr int kHalvings = 8;            ///< of a step whose equation is not solved
constexpr double kLeastMass = 0.25;     ///< of the mass in the matrix
constexpr double kShortest = 1e-3;      ///< a Newton step is not cut below this
constexpr double kRoundings = 16.0;     ///< in each row of the residual
constexpr double kMostRoundOff = 1e-3;  ///< of what acts: a residual above it is not round-off that may stay
constexpr double kOfMomentum = 1e-12;   ///< likewise

}  // namespace

EnergyMomentum::EnergyMomentum(NewtonSettings newton) : newton_(newton) {
  if (newton.iterations < 1 || !(newton.tolerance > 0.0)) {
    throw ParameterError("Newton's iteration needs at least one iteration and a positive tolerance.");
  }
}

void EnergyMomentum::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  system_ = std::make_unique<System>(world, solver, profile);
  start_ = middle_ = end_ = world.rest_state();
  halves_.resize(kHalvings);
  if (!world.frames().empty() || !world.run_time().remembering.empty()) {
    throw ParameterError(
        "the energy-momentum method takes bodies whose nodes have no rotations and that do not remember "
        "(prony); take implicit_midpoint or bdf2 for others.");
  }
  for (auto* v : {&mean_, &given_, &right_, &change_, &way_, &answer_, &work_})
    v->assign(middle_.positions.size(), 0.0);
  gradient_.prepare(*system_);
  contact_.reset();
  load_ = 0.0;
  if (world.contact() != nullptr) prepare_touching(profile);
}

double EnergyMomentum::residual(const State& from, double h) {
  const World& world = system_->world();
  const FixedDofs& fixed = world.fixed();
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    way_[i] = h * mean_[i];
    middle_.positions[i] = from.positions[i] + 0.5 * way_[i];
    end_.positions[i] = from.positions[i] + way_[i];
  }
  middle_.time = end_.time = from.time + 0.5 * h;
  std::ranges::fill(middle_.velocities, 0.0);
  gradient_.find(from, middle_, end_, way_);
  middle_.velocities = mean_;

  system_->force(middle_, right_);
  gradient_.add_force(1.0, right_);
  for (std::size_t i = 0; i < right_.size(); ++i) {
    right_[i] *= 0.5 * h;
    work_[i] = mean_[i] - from.velocities[i];
  }
  std::ranges::fill(answer_, 0.0);
  world.mass().add_product(middle_, -1.0, work_, answer_);
  fixed.clear(answer_);
  external_ = 0.5 * h * system_->external_force(middle_, work_);
  acting_ = std::max({norm(answer_), external_, load_});
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] += answer_[i];
  fixed.clear(right_);
  return norm(right_);
}

bool EnergyMomentum::find_change(double h, StepReport& report) {
  // Of the slope of a M d in d its mass is taken, without the projection.
  const double mass = std::max(kLeastMass, 1.0 - 0.5 * h * h * gradient_.least_factor());
  const auto solve = [&](ConstReals b, std::vector<double>& x) {
    std::ranges::fill(x, 0.0);
    SolveReport solved = system_->solve(b, x, 0.0);
    if (!solved.positive_definite) {
      ++report.indefinite;
      system_->assemble(middle_, std::max(1.0, mass), {-0.25 * h * h, -0.5 * h, true});
      std::ranges::fill(x, 0.0);
      solved = system_->solve(b, x, 0.0);
    }
    report.solver_iterations += solved.iterations;
  };
  system_->assemble(middle_, mass, {-0.25 * h * h, -0.5 * h});
  solve(right_, change_);
  ++report.newton_iterations;
  if (gradient_.is_zero()) return true;
  return gradient_.add_slopes(middle_, end_, way_, h, right_, solve, change_);
}

double EnergyMomentum::round_off(double h) const {
  return kRoundings * system_->round_off(middle_) / h + gradient_.round_off(0.5 * h);
}

bool EnergyMomentum::is_at_round_off(double now, double floor) {
  if (!(now <= floor)) return false;
  if (external_ == 0.0 || now <= kMostRoundOff * acting_) return true;
  // In tiny parts of a step what acts may be less than that, but for the momentum it is nothing.
  std::ranges::fill(work_, 0.0);
  system_->world().mass().add_product(middle_, 1.0, mean_, work_);
  return now <= kOfMomentum * norm(work_);
}

bool EnergyMomentum::iterate(const State& from, double h, StepReport& report) {
  double now = residual(from, h);
  bool found = false;
  for (int i = 0; i <= newton_.iterations && std::isfinite(now); ++i) {
    report.residual = acting_ > 0.0 ? now / acting_ : 0.0;
    found = now <= newton_.tolerance * acting_;
    if (found || i == newton_.iterations) break;
    stop_if_asked();
    if (!find_change(h, report)) break;
    const double floor = round_off(h);
    found = is_at_round_off(now, floor);
    if (found && acting_ <= floor) report.residual = 0.0;  // nothing acts
    if (found) break;
    given_ = mean_;
    double next = 0.0;
    for (double share = 1.0; share > kShortest; share *= 0.5) {
      for (std::size_t k = 0; k < mean_.size(); ++k) mean_[k] = given_[k] + share * change_[k];
      next = residual(from, h);
      if (next < now) break;
    }
    if (!(next < now)) break;
    now = next;
  }
  return found;
}

bool EnergyMomentum::solve(const State& from, double h, State& state, StepReport& report) {
  const FixedDofs& fixed = system_->world().fixed();
  middle_ = from;  // what models remember, too
  end_ = from;
  mean_ = from.velocities;
  fixed.set_velocities(from, from.time + h, h, 1.0, given_);
  fixed.copy(given_, mean_);
  const bool found = contact_ == nullptr ? iterate(from, h, report) : iterate_touching(from, h, report);
  if (!found) return false;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    state.positions[i] = from.positions[i] + h * mean_[i];
    state.velocities[i] = 2.0 * mean_[i] - from.velocities[i];
  }
  if (contact_ != nullptr) finish_touching(from, h, state, report);
  fixed.copy(mean_, state.velocities);
  state.time = from.time + h;
  return true;
}

bool EnergyMomentum::advance(const State& from, double h, int halvings, State& state, StepReport& report) {
  if (solve(from, h, state, report)) return true;
  if (halvings == 0) return false;
  State& middle = halves_[static_cast<std::size_t>(halvings - 1)];
  middle = from;
  if (!advance(from, 0.5 * h, halvings - 1, middle, report)) return false;
  return advance(middle, 0.5 * h, halvings - 1, state, report);
}

StepReport EnergyMomentum::step(State& state, double h) {
  StepReport report;
  start_ = state;
  // Where surfaces touch, the simulation divides the step: so the forces of all parts are counted.
  const int halvings = contact_ == nullptr ? kHalvings : 0;
  report.converged = advance(start_, h, halvings, state, report);
  if (!report.converged) {
    state = start_;
    throw Diverged("the equation of the energy-momentum method was not solved in steps of " +
                       number_text(std::ldexp(h, -halvings)) +
                       " s either; take a smaller dt, or more of Newton's iterations.",
                   "", -1, start_.time);
  }
  report.converged = !report.hasty;
  report.time = state.time;
  return report;
}

}  // namespace tissu
