#include "tissu/simulation/snapshot.h"

#include <memory>
#include <string>

#include "tissu/base/error.h"
#include "tissu/simulation/simulation.h"

namespace tissu {
namespace {

void check_count(const char* what, std::size_t found, std::size_t accepted) {
  if (found == accepted) return;
  throw ParameterError("the snapshot has " + std::to_string(found) + " " + what + " where the world has " +
                       std::to_string(accepted) + "; restore it in the world that it was taken from.");
}

}  // namespace

Snapshot Simulation::snapshot() {
  forget_solves();
  hold();
  Snapshot result;
  result.state = state_;
  result.settled = settled_;
  result.time_before = last_good_.time;
  result.velocities_before = last_good_.velocities;
  result.straining = last_good_.straining;
  result.integrator = integrator_->memory();
  if (watch_) result.energy_watch = watch_->reference(state_);
  result.bodies = topologies(*world_);
  return result;
}

void Simulation::restore(const Snapshot& snapshot) {
  const std::size_t size = world_->rest_positions().size();
  check_count("positions", snapshot.state.positions.size(), size);
  check_count("velocities", snapshot.state.velocities.size(), size);
  check_count("velocities before its latest step", snapshot.velocities_before.size(), size);
  if (!snapshot.straining.empty()) check_count("straining velocities", snapshot.straining.size(), size);
  check_count("rotations", snapshot.state.rotations.size(), world_->frames().size());
  check_count("numbers of the watch on energy", snapshot.energy_watch.size(),
              watch_ ? EnergyWatch::kReferences : 0);
  check_count("edited bodies", snapshot.bodies.size(),
              world_->description() == nullptr ? 0 : world_->bodies().size());
  std::shared_ptr<const World> left = with_topologies(*world_, snapshot.bodies);
  const World& world = left == nullptr ? *world_ : *left;
  check_memory(world, snapshot.state);
  if (left != nullptr) replace_world(std::move(left));
  contact_forces_.clear();
  state_ = snapshot.state;
  last_good_ = snapshot.state;
  last_good_.time = snapshot.time_before;
  last_good_.velocities = snapshot.velocities_before;
  last_good_.straining = snapshot.straining;
  held_ = snapshot.state.velocities;
  if (watch_) watch_->restore(snapshot.energy_watch, state_);
  settled_ = snapshot.settled;
  integrator_->restore(snapshot.integrator);
  forget_solves();
}

}  // namespace tissu
