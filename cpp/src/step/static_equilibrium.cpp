#include "tissu/step/static_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr int kHalvings = 12;  ///< of a part of the load, …
constexpr int kSearches = 4;   ///< … before the barrier goes on where the searches of contacts do not end
constexpr int kRoom = 19;      ///< parts beyond load_steps for which iterations are set aside
constexpr int kEasy = 6;       ///< iterations of a part after which the next one is larger, …
constexpr int kEasyTouching = 30;  ///< … and where contacts are looked at between them
constexpr int kMoreTouching = 4;   ///< times as many iterations of a step, where none are given
constexpr int kPolish = 200;       ///< iterations that bring what the barrier holds to its gap
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
  barrier_.reset();
  if (world.contact() != nullptr) touching_ = StaticContact::make(*equilibrium_, profile);
  profile_ = &profile;
  start_ = before_ = world.rest_state();
}

int StaticEquilibrium::left(const StepReport& report) const {
  const int times = touching_ && !is_bounded_ ? kMoreTouching : 1;
  return std::max(0, times * settings_.total_iterations - (report.newton_iterations - set_aside_));
}

StepReport StaticEquilibrium::step(State& state, double h) {
  StepReport report;
  std::ranges::fill(state.velocities, 0.0);
  start_ = state;
  const LoadPath path(equilibrium_->world(), start_, h, loaded_);
  equilibrium_->begin(path, state);
  solver_gave_up_ = false;
  arc_ended_ = ArcLength::End::unused;
  by_ = touching_.get();
  set_aside_ = 0;
  rests_at_gap_ = true;
  why_not_by_barrier_.clear();
  tries_barrier_ =
      touching_ && equilibrium_->world().contact()->description().method == ContactMethod::augmented;
  double share = settings_.arc_length ? go_by_arc(path, 0.0, 1.0 / settings_.load_steps, state, report)
                                      : go_by_parts(path, 0.0, state, report);
  const double before = share;
  if (share < 1.0 && may_go_on_by_barrier()) share = go_on_by_barrier(path, share, state, report);
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
      (touching_ ? by_->is_unstable() : equilibrium_->is_unstable(state))) {
    report.message =
        "an unstable equilibrium: the tangent is indefinite there, and a body that is disturbed leaves it; "
        "to "
        "see where it goes let a damped body come to rest in steps of time (implicit_euler, rayleigh)";
  }
  if (report.converged && by_ != nullptr && by_ == barrier_.get()) {
    if (!report.message.empty()) report.message += "; ";
    report.message +=
        "beyond " + number_text(100.0 * before) +
        " % of the load the searches of augmented contacts did not end, and the barrier went on";
    if (!rests_at_gap_) report.message += "; surfaces rest up to two gaps apart";
  }
  path.load(1.0, state);
  loaded_ = loaded_ || report.converged;
  report.time = state.time;
  return report;
}

bool StaticEquilibrium::may_go_on_by_barrier() const { return tries_barrier_ && touching_->found_no_end(); }

double StaticEquilibrium::go_on_by_barrier(const LoadPath& path, double share, State& state,
                                           StepReport& report) {
  if (!barrier_) barrier_ = std::make_unique<StaticBarrier>(*equilibrium_, *profile_);
  by_ = barrier_.get();
  if (!is_bounded_) set_aside_ = report.newton_iterations;
  const double to = go_by_parts(path, share, state, report);
  if (to >= 1.0) {
    before_ = state;
    rests_at_gap_ = barrier_->find_at_gap(path, to, kPolish, state, report);
    if (!rests_at_gap_) {
      state = before_;
      equilibrium_->is_reached(to, state, equilibrium_->residual(state), 0.0, report);
    }
    return to;
  }
  why_not_by_barrier_ = barrier_->reason();
  by_ = touching_.get();
  tries_barrier_ = false;
  if (!is_bounded_) set_aside_ = report.newton_iterations;
  return go_by_parts(path, to, state, report);
}

double StaticEquilibrium::go_by_parts(const LoadPath& path, double share, State& state, StepReport& report) {
  double largest = std::min(1.0 / settings_.load_steps, path.largest_part(kTurn));
  if (touching_) largest = std::min(largest, by_->largest_part(path, start_));
  const double smallest = std::ldexp(largest, -kHalvings);
  const double largest_searched = std::ldexp(largest, -kSearches);
  double part = largest;
  const int easy = touching_ ? kEasyTouching : kEasy;
  while (share < 1.0) {
    const double to = share + part * (1.0 + 1e-9) >= 1.0 ? 1.0 : share + part;
    const int before = report.newton_iterations;
    if (take(path, share, to, state, report)) {
      share = to;
      solver_gave_up_ = false;
      if (report.newton_iterations - before <= easy) part = std::min(2.0 * part, largest);
    } else if (left(report) == 0 || (touching_ && part < 2.0 * smallest) ||
               (part < 2.0 * largest_searched && by_ == touching_.get() && may_go_on_by_barrier())) {
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
    const bool found = by_->find(path, from, to, left(report), state, report);
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
  std::string why = touching_->reason();
  if (!why_not_by_barrier_.empty()) why += ", and by the method barrier: " + why_not_by_barrier_;
  throw Diverged("in the static step from t = " + number_text(from) + " s with dt = " + number_text(h) +
                     " s no equilibrium was found beyond " + number_text(100.0 * share) +
                     " % of the load: " + why + ". The simulation stands at its last good step.",
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
