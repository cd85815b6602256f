#include "tissu/step/static_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr int kHalvings = 12;      ///< of a part of the load
constexpr int kRoom = 19;          ///< parts beyond load_steps for which iterations are set aside
constexpr int kEasy = 6;           ///< iterations of a part after which the next one is larger, …
constexpr int kEasyTouching = 30;  ///< … and where contacts are looked at between them
constexpr int kMoreTouching = 4;   ///< times as many iterations of a step, where none are given
constexpr double kTurn = std::numbers::pi / 6.0;  ///< by which led nodes go round in one part, at most

}  // namespace

StaticEquilibrium::StaticEquilibrium(Settings settings) : settings_(settings) {
  if (settings.load_steps < 1 || settings.newton.iterations < 1 || !(settings.newton.tolerance > 0.0)) {
    throw ParameterError(
        "static equilibrium needs at least one load step, one Newton iteration and a positive tolerance.");
  }
  is_bounded_ = settings_.total_iterations >= 1;
  if (!is_bounded_) {
    settings_.total_iterations = settings.newton.iterations * (settings.load_steps + kRoom);
  }
}

void StaticEquilibrium::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  equilibrium_ = std::make_unique<Equilibrium>(world, solver, profile, settings_.newton);
  arc_ = std::make_unique<ArcLength>(*equilibrium_, settings_.newton);
  touching_.reset();
  if (world.contact() != nullptr) touching_ = StaticContact::make(*equilibrium_, profile);
  start_ = before_ = world.rest_state();
}

int StaticEquilibrium::left(const StepReport& report) const {
  const int times = touching_ && !is_bounded_ ? kMoreTouching : 1;
  return std::max(0, times * settings_.total_iterations - report.newton_iterations);
}

StepReport StaticEquilibrium::step(State& state, double h) {
  StepReport report;
  std::ranges::fill(state.velocities, 0.0);
  start_ = state;
  const LoadPath path(equilibrium_->world(), start_, h, loaded_);
  equilibrium_->begin(path, state);
  solver_gave_up_ = false;
  arc_ended_ = ArcLength::End::unused;
  const double share = settings_.arc_length ? go_by_arc(path, 0.0, 1.0 / settings_.load_steps, state, report)
                                            : go_by_parts(path, state, report);
  report.converged = share >= 1.0;
  if (touching_ && !report.converged) refuse(share, h);
  if (!report.converged) {
    report.message =
        "no equilibrium was found beyond " + number_text(100.0 * share) + " % of the load: " + reason();
  }
  if (report.converged && equilibrium_->is_at_round_off()) {
    report.message = "equilibrium to round-off, which leaves " + number_text(100.0 * report.residual) +
                     " % of the load where forces within the bodies are so much larger";
  }
  if (report.converged && report.message.empty() &&
      (touching_ ? touching_->is_unstable() : equilibrium_->is_unstable(state))) {
    report.message =
        "an unstable equilibrium: the tangent is indefinite there, and a body that is disturbed leaves it; "
        "to "
        "see where it goes let a damped body come to rest in steps of time (implicit_euler, rayleigh)";
  }
  path.load(1.0, state);
  loaded_ = loaded_ || report.converged;
  report.time = state.time;
  return report;
}

double StaticEquilibrium::go_by_parts(const LoadPath& path, State& state, StepReport& report) {
  double largest = std::min(1.0 / settings_.load_steps, path.largest_part(kTurn));
  if (touching_) largest = std::min(largest, touching_->largest_part(path, start_));
  const double smallest = std::ldexp(largest, -kHalvings);
  double share = 0.0;
  double part = largest;
  const int easy = touching_ ? kEasyTouching : kEasy;
  while (share < 1.0) {
    const double to = share + part * (1.0 + 1e-9) >= 1.0 ? 1.0 : share + part;
    const int before = report.newton_iterations;
    if (take(path, share, to, state, report)) {
      share = to;
      solver_gave_up_ = false;
      if (report.newton_iterations - before <= easy) part = std::min(2.0 * part, largest);
    } else if (left(report) == 0 || (touching_ && part < 2.0 * smallest)) {
      return share;
    } else if (part < 2.0 * smallest) {
      return go_by_arc(path, share, part, state, report);
    } else {
      part = 0.5 * (to - share);
    }
  }
  return share;
}

double StaticEquilibrium::go_by_arc(const LoadPath& path, double share, double part, State& state,
                                    StepReport& report) {
  arc_ended_ = arc_->follow(path, share, part, settings_.total_iterations, state, report);
  return arc_ended_ == ArcLength::End::reached ? 1.0 : std::min(share, 1.0 - 1e-9);
}

bool StaticEquilibrium::take(const LoadPath& path, double from, double to, State& state, StepReport& report) {
  before_ = state;
  if (touching_) {
    const bool found = touching_->find(path, from, to, left(report), state, report);
    if (!found) state = before_;
    return found;
  }
  for (const auto search : {Equilibrium::Search::none, Equilibrium::Search::energy}) {
    // A descent may be long, as that of a body that topples; half of what is left stays for smaller parts.
    const int share = search == Equilibrium::Search::energy ? left(report) / 2 : 0;
    const int most = std::min(std::max(settings_.newton.iterations, share), left(report));
    const auto end = equilibrium_->find(path, from, to, search, most, state, report);
    if (end == Equilibrium::End::reached) return true;
    solver_gave_up_ = solver_gave_up_ || end == Equilibrium::End::solver;
    state = before_;
    if (equilibrium_->world().is_linear()) break;
  }
  return false;
}

void StaticEquilibrium::refuse(double share, double h) const {
  const double from = start_.time;
  throw Diverged("in the static step from t = " + number_text(from) + " s with dt = " + number_text(h) +
                     " s no equilibrium was found beyond " + number_text(100.0 * share) + " % of the load: " +
                     touching_->reason() + ". The simulation stands at its last good step.",
                 "", -1, from);
}

std::string StaticEquilibrium::reason() const {
  const std::string all =
      "all " + std::to_string(settings_.total_iterations) + " iterations of Newton's method were used";
  const std::string more =
      "; give Newton's method more iterations, or let a damped body come to rest in steps of time "
      "(implicit_euler, rayleigh)";
  if (solver_gave_up_) {
    return "the linear solver stopped before its tolerance; give it more iterations or a better "
           "preconditioner, or take cholesky";
  }
  switch (arc_ended_) {
    case ArcLength::End::released:
      return "the load turns, and the path of equilibria leads back below no load; a body that is loaded "
             "further has no equilibrium near";
    case ArcLength::End::no_longer:
      return "neither parts of the load nor its arc length find an equilibrium near" + more;
    default:
      return all + more;
  }
}

}  // namespace tissu
