/// Steps that contact, or the rotations of nodes, make too long for one go.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "culprit.h"
#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/number_text.h"
#include "tissu/contact/bent_ways.h"
#include "tissu/contact/contact.h"
#include "tissu/simulation/simulation.h"

namespace tissu {
namespace {

constexpr int kHalvings = 3;       ///< at most: eight parts, …
constexpr int kHalvingsRigid = 6;  ///< 64 parts where nothing is soft: they cost little
constexpr int kMostHalvings = 10;  ///< … and 1,024 of a step that diverges, gains energy or goes far
constexpr double kTooDeep = 0.5;   ///< of the gap
constexpr double kFar = 1.0;       ///< mean edges that nodes go beside each other

/// The report of two parts of a step, one after the other.
StepReport sum(const StepReport& first, const StepReport& then) {
  StepReport both = then;
  both.newton_iterations += first.newton_iterations;
  both.solver_iterations += first.solver_iterations;
  both.indefinite += first.indefinite;
  both.residual = std::max(first.residual, then.residual);
  both.converged = first.converged && then.converged;
  both.held_back = std::max(first.held_back, then.held_back);
  both.least_gap = std::min(first.least_gap, then.least_gap);
  both.substeps = first.substeps + then.substeps;
  if (both.message.empty()) both.message = first.message;
  return both;
}

int enough_halvings(const World& world) { return world.bodies().empty() ? kHalvingsRigid : kHalvings; }

[[noreturn]] void refuse_part(double time, double h, bool touches, bool is_explicit, const Culprit& culprit,
                              const Error& error) {
  std::string message = "the step from t = " + number_text(time) + " s diverged" +
                        (touches ? " where surfaces meet" : "") + ", also in parts of " + number_text(h) +
                        " s: " + error.what();
  if (culprit.element >= 0) message += " Please " + look_at(culprit) + ".";
  message += " The simulation stands at its last good step; take ";
  message +=
      is_explicit ? "an implicit method, a smaller share of the stable step as dt, " : "a smaller dt, ";
  message += "a stable law, or ";
  message += touches ? "let things meet more slowly." : "load more slowly.";
  throw Diverged(message, culprit.body, culprit.element, time);
}

void say_held_back(StepReport& report) {
  report.converged = false;
  report.message =
      std::to_string(report.held_back) +
      " rows had to be held back, where surfaces would pass through each other, in the shortest part "
      "of the step; take a smaller dt";
}

void say_turned(StepReport& report) {
  report.converged = false;
  report.message =
      "nodes turn by more than half a radian in the shortest part of the step; take a smaller dt";
}

void say_deep(StepReport& report) {
  report.converged = false;
  report.message =
      "contacts are still deeper than half the gap after the parts of the step; take a smaller dt";
}

/// How much farther some nodes of bodies in contact went than others, over the shortest mean edge of their
/// surfaces: what all of them go together does not count.
double edges_gone(const World& world, const State& from, const State& to) {
  if (world.contact() == nullptr) return 0.0;
  const SurfaceSet& surfaces = world.contact()->surfaces();
  Vec3 least = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 most = -least;
  double edge = std::numeric_limits<double>::infinity();
  const auto count = [&](const Body& body) {
    for (std::int32_t row = body.first_node; row < body.first_node + body.node_count; ++row) {
      const Vec3 way = block(ConstReals(to.positions), row) - block(ConstReals(from.positions), row);
      least = least.cwiseMin(way);
      most = most.cwiseMax(way);
    }
  };
  for (std::size_t i = 0; i < surfaces.surfaces().size(); ++i) {
    const SurfaceSet::Surface& surface = surfaces.surfaces()[i];
    const double mean = surfaces.mean_edge(static_cast<std::int32_t>(i));
    if (surface.obstacle >= 0 || !(mean > 0.0)) continue;
    edge = std::min(edge, mean);
    const auto body = std::ranges::find(world.bodies(), surface.first_row, &Body::first_node);
    if (body != world.bodies().end()) count(*body);
  }
  return std::max(0.0, (most - least).maxCoeff()) / edge;
}

}  // namespace

/// Whether a part of 2^-halvings of a step gave more energy than contacts may give in it.
bool Simulation::gains_energy(const State& start, int halvings) {
  if (!watch_ || is_led_live()) return false;
  const double gain =
      energy_of(*world_, state_, scratch_).total() - energy_of(*world_, start, scratch_).total();
  return watch_->growth_by(gain, std::ldexp(1.0, -halvings)) > EnergyWatch::kReported;
}

/// Where a step has to hold nodes back, or leaves more residual than it found, it was too long: shorter ones
/// see contacts come. Eight parts have to do, except for impacts in which nodes would go by cells in one
/// part: a single linearisation there crushes cells and throws them out again. The same holds for nodes that
/// turn far, until they do not.
StepReport Simulation::step_in_parts(double h, int halvings) {
  const auto level = static_cast<std::size_t>(halvings);
  if (part_starts_.size() <= level) part_starts_.resize(level + 1);
  PartStart& start = part_starts_[level];
  start.state = state_;
  start.integrator.clear();
  integrator_->append_memory(start.integrator);
  const bool last = halvings == kMostHalvings;
  std::optional<StepReport> report;
  const int enough = enough_halvings(*world_);
  integrator_->take_part(halvings < enough, std::ldexp(1.0, -halvings));
  const bool bent = !last && world_->contact() != nullptr && are_ways_bent(*world_->contact(), state_, h);
  try {
    if (!bent) report = integrator_->step(state_, h);
  } catch (const Interrupted&) {
    throw;
  } catch (const Diverged&) {
    if (last) throw;
    report.reset();
  } catch (const Error& error) {  // of values that are not finite, wherever they were met first
    if (last) {
      const Culprit culprit = culprit_of(*world_, start.state, farthest() / h);
      refuse_part(start.state.time, h, world_->contact() != nullptr, solver_ == nullptr, culprit, error);
    }
    report.reset();
  }
  const bool finite = report && std::isfinite(report->residual) && is_sane();
  const bool good = finite && report->held_back == 0 && !report->hasty && !report->turned_far;
  const auto end = [&] {
    if (halvings > 0 && world_->contact() != nullptr) {
      world_->contact()->add_part(std::ldexp(1.0, -halvings), state_);
    }
    return *report;
  };
  if (good) return end();
  const auto tame = [&] {
    return !report->turned_far && edges_gone(*world_, start.state, state_) <= kFar &&
           !gains_energy(start.state, halvings);
  };
  if (finite && halvings >= enough && (last || tame())) {
    if (report->held_back > 0) say_held_back(*report);
    if (report->turned_far) say_turned(*report);
    return end();
  }
  if (last) roll_back(h);
  state_ = start.state;
  integrator_->restore(start.integrator);
  const StepReport first = step_in_parts(0.5 * h, halvings + 1);
  remember(*world_, state_);
  StepReport both = sum(first, step_in_parts(0.5 * h, halvings + 1));
  // Parts open what is too deep by shares, so that each of them may have converged.
  if (halvings == 0 && both.converged && both.depth > kTooDeep) say_deep(both);
  return both;
}

}  // namespace tissu
