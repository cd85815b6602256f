#include "tissu/step/energy_momentum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr int kHalvings = 8;            ///< of a step whose equation is not solved
constexpr double kLeastMass = 0.25;     ///< of the mass in the matrix
constexpr double kShortest = 1e-3;      ///< a Newton step is not cut below this
constexpr double kRoundings = 16.0;     ///< in each row of the residual, and in the stored energy
constexpr double kMostRoundOff = 1e-3;  ///< of what acts: a residual above it is not round-off that may stay
constexpr double kOfMomentum = 1e-12;   ///< likewise
constexpr double kSmallest = 1e3 * std::numeric_limits<double>::epsilon();
/// Shares of the size of the world: so far it is moved to see the round-off of its energy.
constexpr std::array<double, 3> kMoves{0.13, 0.37, 0.71};

double dot(ConstReals a, ConstReals b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

}  // namespace

EnergyMomentum::EnergyMomentum(NewtonSettings newton) : newton_(newton) {
  if (newton.iterations < 1 || !(newton.tolerance > 0.0)) {
    throw ParameterError("Newton's iteration needs at least one iteration and a positive tolerance.");
  }
}

void EnergyMomentum::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  system_ = std::make_unique<System>(world, solver, profile);
  momentum_free_.prepare(world);
  start_ = middle_ = end_ = world.rest_state();
  halves_.resize(kHalvings);
  if (!world.frames().empty() || !world.run_time().remembering.empty()) {
    throw ParameterError(
        "the energy-momentum method takes bodies whose nodes have no rotations and that do not remember "
        "(prony); take implicit_midpoint or bdf2 for others.");
  }
  for (auto* v : {&mean_, &given_, &right_, &change_, &way_, &free_way_, &push_, &elastic_, &slope_, &answer_,
                  &work_}) {
    v->assign(middle_.positions.size(), 0.0);
  }
  find_round_off();
  contact_.reset();
  if (world.contact() != nullptr) prepare_touching(profile);
}

/// A rigid motion stores nothing: what the energy changes by is the round-off of its terms, which are far
/// larger in a law that does not vanish at rest, and so is the force.
void EnergyMomentum::find_round_off() {
  middle_ = system_->world().rest_state();
  const auto [low, high] = std::ranges::minmax(middle_.positions);
  const double rest = stored(middle_);
  energy_round_off_ = force_round_off_ = 0.0;
  for (const double share : kMoves) {
    end_ = middle_;
    for (double& x : end_.positions) x += share * (high - low);
    energy_round_off_ = std::max(energy_round_off_, kRoundings * std::abs(stored(end_) - rest));
    elastic_force(end_, elastic_);
    force_round_off_ = std::max(force_round_off_, kRoundings * norm(elastic_));
  }
  end_ = middle_;
}

double EnergyMomentum::stored(const State& state) {
  double sum = 0.0;
  for (const auto& model : system_->world().forces()) {
    if (model->kind() == ForceKind::elastic) sum += model->energy(state, system_->scratch());
  }
  return sum;
}

void EnergyMomentum::elastic_force(const State& state, std::vector<double>& f) {
  std::ranges::fill(f, 0.0);
  for (const auto& model : system_->world().forces()) {
    if (model->kind() == ForceKind::elastic) model->add_force(state, system_->scratch(), f);
  }
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
  elastic_force(middle_, elastic_);
  middle_.velocities = mean_;

  free_way_ = way_;
  // The way of led nodes stays in it: what they store beyond the work of their reactions in the first step
  // from rest cannot be given to free nodes, which have hardly moved.
  momentum_free_.project(middle_.positions, free_way_);
  std::ranges::fill(push_, 0.0);
  world.mass().add_product(middle_, 1.0, free_way_, push_);
  square_ = dot(free_way_, push_);
  const double before = stored(from);
  const double after = stored(end_);
  const double left = after - before + dot(elastic_, way_);
  energy_floor_ =
      energy_round_off_ + force_round_off_ * norm(way_) + kSmallest * (std::abs(after) + std::abs(before));
  const bool is_round_off = std::abs(left) <= energy_floor_ ||
                            square_ <= kSmallest * kSmallest * dot(way_, way_) * world.mass().total();
  factor_ = is_round_off ? 0.0 : -left / square_;

  system_->force(middle_, right_);
  for (std::size_t i = 0; i < right_.size(); ++i) {
    right_[i] = 0.5 * h * (right_[i] + factor_ * push_[i]);
    work_[i] = mean_[i] - from.velocities[i];
  }
  std::ranges::fill(answer_, 0.0);
  world.mass().add_product(middle_, -1.0, work_, answer_);
  fixed.clear(answer_);
  external_ = 0.5 * h * system_->external_force(middle_, work_);
  acting_ = std::max(norm(answer_), external_);
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] += answer_[i];
  fixed.clear(right_);
  return norm(right_);
}

bool EnergyMomentum::find_change(double h, StepReport& report) {
  const FixedDofs& fixed = system_->world().fixed();
  // Of the slope of a M d in d its mass is taken, without the projection.
  const double mass = std::max(kLeastMass, 1.0 - 0.5 * h * h * factor_);
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
  if (factor_ == 0.0) return true;
  // a changes by -(f_W(x) - f_W(x1) - K (x1 - x0) / 2 + 2 a M d) . dx / (d . M d), dx = h dv: a matrix of
  // rank one beside the midpoint rule's, solved with by Sherman and Morrison's formula.
  elastic_force(end_, slope_);
  std::ranges::fill(work_, 0.0);
  for (const auto& model : system_->world().forces()) {
    if (model->kind() != ForceKind::elastic) continue;
    model->add_product(middle_, system_->scratch(), {0.5, 0.0}, way_, work_);
  }
  for (std::size_t i = 0; i < slope_.size(); ++i) {
    slope_[i] = -h * (elastic_[i] - slope_[i] + work_[i] + 2.0 * factor_ * push_[i]) / square_;
  }
  fixed.clear(slope_);
  fixed.clear(push_);
  solve(push_, answer_);
  const double down = 1.0 - 0.5 * h * dot(slope_, answer_);
  const double share = 0.5 * h * dot(slope_, change_) / down;
  if (!std::isfinite(share)) return false;
  for (std::size_t i = 0; i < change_.size(); ++i) change_[i] += share * answer_[i];
  return true;
}

double EnergyMomentum::round_off(double h) const {
  const double of_matrix = kRoundings * system_->round_off(middle_) / h;
  return factor_ == 0.0 ? of_matrix : of_matrix + 0.5 * h * energy_floor_ / square_ * norm(push_);
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
