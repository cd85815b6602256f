#include "tissu/simulation/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr double kTooFar = 1e3;  ///< sizes of the scene

struct Worst {
  std::string body;
  std::int32_t element = -1;
  double volume_ratio = std::numeric_limits<double>::infinity();
};

/// The cell that is squeezed or turned over most.
Worst worst_cell(const World& world, const State& state) {
  Worst worst;
  for (const Body& body : world.bodies()) {
    std::int32_t first = 0;
    for (const Elastic* elastic : body.elastic) {
      const CellFields fields = elastic->fields(state);
      const auto& numbers = elastic->block().cell_numbers;
      for (std::size_t e = 0; e < fields.volume_ratio.size(); ++e) {
        if (fields.volume_ratio[e] < worst.volume_ratio) {
          worst = {body.name, numbers.empty() ? first + static_cast<std::int32_t>(e) : numbers[e],
                   fields.volume_ratio[e]};
        }
      }
      first += elastic->cell_count();
    }
  }
  return worst;
}

std::string text(double value) {
  char buffer[32];
  (void)std::snprintf(buffer, sizeof buffer, "%.4g", value);
  return buffer;
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const World> world, std::unique_ptr<Integrator> integrator,
                       std::unique_ptr<LinearSolver> solver)
    : world_(std::move(world)),
      integrator_(std::move(integrator)),
      solver_(std::move(solver)),
      state_(world_->rest_state()),
      last_good_(state_) {
  integrator_->prepare(*world_, profile_);
}

StepReport Simulation::step(double h) {
  if (!(h > 0.0) || !std::isfinite(h)) {
    throw ParameterError("the step is " + text(h) + " s; it must be positive and finite.");
  }
  const auto start = std::chrono::steady_clock::now();
  last_good_ = state_;
  StepReport report;
  try {
    report = integrator_->step(state_, h, *solver_);
  } catch (...) {
    state_ = last_good_;
    throw;
  }
  if (!std::isfinite(report.residual) || !is_sane()) roll_back(h);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  profile_.add_step(seconds);
  report.milliseconds = 1e3 * seconds;
  return report;
}

bool Simulation::is_sane() const {
  const double limit = kTooFar * std::max(world_->extent(), 1e-6);
  bool sane = true;
  for (std::size_t i = 0; i < state_.positions.size(); ++i) {
    sane = sane && std::abs(state_.positions[i] - last_good_.positions[i]) < limit &&
           std::isfinite(state_.velocities[i]);
  }
  return sane;
}

void Simulation::roll_back(double h) {
  state_ = last_good_;
  const Worst worst = worst_cell(*world_, state_);
  std::string message = "the step from t = " + text(state_.time) + " s with dt = " + text(h) +
                        " s gave values that are not finite or fly out of the scene";
  if (worst.element >= 0) {
    message += "; before it, cell " + std::to_string(worst.element) + " of body \"" + worst.body +
               "\" was the most squeezed (volume ratio " + text(worst.volume_ratio) + ")";
  }
  message +=
      ". The simulation stands at its last good step; take a smaller dt, iterate Newton, or load more "
      "slowly.";
  throw Diverged(message, worst.body, worst.element, state_.time);
}

Energy Simulation::energy() const {
  Energy energy;
  energy.kinetic = world_->mass().kinetic_energy(state_);
  for (const auto& model : world_->forces()) {
    (model->kind() == ForceKind::elastic ? energy.elastic : energy.potential) += model->energy(state_);
  }
  return energy;
}

void Simulation::replace_world(std::shared_ptr<const World> world) {
  if (world->blocks() != world_->blocks()) {
    throw ParameterError("the new world has other unknowns than the one that runs.");
  }
  integrator_->prepare(*world, profile_);
  world_ = std::move(world);
}

}  // namespace tissu
