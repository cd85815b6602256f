#include "tissu/simulation/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "culprit.h"
#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/number_text.h"
#include "tissu/world/run_time.h"

namespace tissu {
namespace {

constexpr double kTooFar = 1e3;  ///< sizes of the scene

/// Whether energy can only be kept or lost, where a method, contacts or damping could add some.
bool is_watched(const World& world, const Integrator& integrator, bool solves) {
  const bool implicit = solves && !integrator.is_static();
  const bool touches = implicit && world.contact() != nullptr;
  const bool driven = implicit && EnergyWatch::may_be_driven(world);
  return (integrator.is_undamped() || touches || driven) && EnergyWatch::can_watch(world);
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const World> world, std::unique_ptr<Integrator> integrator,
                       std::unique_ptr<LinearSolver> solver)
    : world_(std::move(world)),
      integrator_(std::move(integrator)),
      solver_(std::move(solver)),
      state_(world_->rest_state()),
      last_good_(state_),
      held_(state_.velocities) {
  integrator_->prepare(*world_, solver_.get(), profile_);
  renew_watch();
  if (integrator_->is_static()) inverted_.emplace(*world_);
}

void Simulation::renew_watch() {
  watch_.reset();
  if (is_watched(*world_, *integrator_, solver_ != nullptr)) watch_.emplace();
}

void Simulation::prepare_ahead(double h) {
  if (solver_ == nullptr || !(h > 0.0) || !std::isfinite(h)) return;
  State ahead = state_;
  try {
    begin_step(*world_, ahead, scratch_, h);
    integrator_->prepare_ahead(ahead, h);
  } catch (const Interrupted&) {
    throw;
  } catch (const Error&) {  // the step will say it
    solver_->forget();
  }
}

double Simulation::stable_step() {
  const double h = integrator_->stable_step(state_);
  if (!std::isnan(h)) return h;
  const Culprit culprit = worst_cell(*world_, state_);
  std::string message = "the stiffness at t = " + number_text(state_.time) + " s is not a number";
  if (culprit.element >= 0) {
    message +=
        ": in cell " + std::to_string(culprit.element) + " of body \"" + culprit.body + "\" " + culprit.why;
  }
  message +=
      "; go back to an earlier state, and take a smaller dt, an implicit method, or a law that bears it, "
      "such as "
      "stable_neo_hooke.";
  throw Diverged(message, culprit.body, culprit.element, state_.time);
}

StepReport Simulation::step(double h) {
  if (!(h > 0.0) || !std::isfinite(h)) {
    throw ParameterError("the step is " + number_text(h) + " s; it must be positive and finite.");
  }
  const auto start = std::chrono::steady_clock::now();
  profile_.begin_step();
  contact_forces_.clear();
  hold();
  last_good_ = state_;
  StepReport report;
  try {
    if (watch_)
      watch_->begin(*world_, state_);  // before models forget in their memory what the last step was
    begin_step(*world_, state_, scratch_, h);
    // A live target gives energy while it leads: the watch begins anew after it.
    if (watch_ && is_led_live()) watch_.emplace();
    if (watch_) watch_->ignore_round_off(*world_, h);
    if (watch_ && world_->contact() != nullptr) watch_->allow_contacts(*world_, h);
    const bool whole = (world_->contact() == nullptr && world_->frames().empty()) || integrator_->is_static();
    report = whole ? integrator_->step(state_, h) : step_in_parts(h, 0);
  } catch (...) {
    state_ = last_good_;
    throw;
  }
  if (!std::isfinite(report.residual) || !is_sane()) roll_back(h);
  last_good_.straining.swap(state_.straining);
  state_.straining.clear();
  remember(*world_, state_);
  if (watch_) watch_energy(*watch_, report);
  world_->fixed().copy(state_.velocities, held_);
  settled_ = false;
  if (inverted_) tell_inverted(*inverted_, report);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  profile_.add_step(seconds);
  report.milliseconds = 1e3 * seconds;
  return report;
}

bool Simulation::is_led_live() const {
  const Contact* contact = world_->contact();
  return world_->fixed().is_led_live(state_) || (contact != nullptr && contact->is_any_led_live(state_));
}

void Simulation::watch_energy(EnergyWatch& watch, StepReport& report) {
  if (is_led_live()) return;
  watch.end(*world_, state_);
  if (watch.growth() <= EnergyWatch::kReported) return;
  if (watch.growth() <= EnergyWatch::kRefused) {
    report.converged = false;
    report.message = watch.say(*world_);
    return;
  }
  const Culprit culprit = worst_cell(*world_, state_);
  const std::string message = "in the step from t = " + number_text(last_good_.time) + " s " +
                              watch.say(*world_) + ". The simulation stands at its last good step.";
  watch.take_back();
  last_good_.straining.clear();
  state_ = last_good_;
  throw Diverged(message, culprit.body, culprit.element, state_.time);
}

void Simulation::tell_inverted(InversionCheck& check, StepReport& report) {
  if (!report.converged) return;
  settle();
  if (!check.any(*world_, state_)) return;
  report.message += (report.message.empty() ? "" : "; ") + say_inverted(*world_, state_);
}

std::vector<double> Simulation::reactions() const {
  std::vector<double> result(state_.positions.size(), 0.0);
  Scratch scratch;
  if (last_good_.straining.empty()) {
    for (const auto& model : world_->forces()) model->add_force(state_, scratch, result);
  } else {  // parts turned in the step: its viscous forces are those of what strained
    State stepped = state_;
    stepped.straining = last_good_.straining;
    for (const auto& model : world_->forces()) model->add_force(stepped, scratch, result);
  }
  for (double& value : result) value = -value;
  const double h = state_.time - last_good_.time;
  if (h > 0.0) {
    std::vector<double> change = state_.velocities;
    for (std::size_t i = 0; i < change.size(); ++i) change[i] -= last_good_.velocities[i];
    world_->mass().add_product(state_, 1.0 / h, change, result);
  }
  const std::vector<std::uint8_t>& masks = world_->fixed().masks();
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (((masks[i / 3] >> (i % 3)) & 1) == 0) result[i] = 0.0;
  }
  for (const Body& body : world_->bodies()) {
    for (const BodyModel* model : body.models) {
      for (const std::int32_t node : model->eliminated()) block(Reals(result), node).setZero();
    }
  }
  return result;
}

void Simulation::settle() {
  if (settled_) return;
  for (const Body& body : world_->bodies()) {
    for (const BodyModel* model : body.models) {
      if (!model->eliminated().empty()) model->settle(state_);
    }
  }
  settled_ = true;
}

/// How far a node may move in one step [m]; a scene without extent has no measure of it.
double Simulation::farthest() const {
  return world_->extent() > 0.0 ? kTooFar * world_->extent() : std::numeric_limits<double>::infinity();
}

bool Simulation::is_sane() const {
  const double limit = farthest();
  bool sane = true;
  for (std::size_t i = 0; i < state_.positions.size(); ++i) {
    sane = sane && std::abs(state_.positions[i] - last_good_.positions[i]) < limit &&
           std::isfinite(state_.velocities[i]);
  }
  // Methods that do not damp may solve for a state in the middle, beyond which a cell is inside out. The
  // watch sees that by itself.
  return sane && (watch_ || !integrator_->is_undamped() || std::isfinite(energy().total()));
}

void Simulation::roll_back(double h) {
  state_ = last_good_;
  const Culprit culprit = culprit_of(*world_, state_, farthest() / h);
  std::string message = "the step from t = " + number_text(state_.time) + " s with dt = " + number_text(h) +
                        " s gave values that are not finite or fly out of the scene";
  if (culprit.element >= 0) message += "; " + look_at(culprit);
  message += ". The simulation stands at its last good step; take ";
  message += solver_ != nullptr ? "a smaller dt, iterate Newton, or load more slowly."
                                : "an implicit method, a smaller share of the stable step as dt, or load "
                                  "more slowly.";
  throw Diverged(message, culprit.body, culprit.element, state_.time);
}

Energy Simulation::energy() const {
  Scratch scratch;
  return energy_of(*world_, state_, scratch);
}

void Simulation::forget_solves() {
  if (solver_ != nullptr) solver_->forget();
}

}  // namespace tissu
