#include "tissu/simulation/snapshot.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "tissu/base/error.h"
#include "tissu/edit/remove_cells.h"
#include "tissu/simulation/simulation.h"

namespace tissu {
namespace {

void check_count(const char* what, std::size_t found, std::size_t accepted) {
  if (found == accepted) return;
  throw ParameterError("the snapshot has " + std::to_string(found) + " " + what + " where the world has " +
                       std::to_string(accepted) + "; restore it in the world that it was taken from.");
}

std::vector<std::int32_t> ascending(std::vector<std::int32_t> numbers) {
  std::ranges::sort(numbers);
  return numbers;
}

/// Numbers of the cells that are in the world and not in the snapshot.
std::vector<std::int32_t> removed_cells(const World& world, const Snapshot::BodyCells& body) {
  const std::vector<std::int32_t> now = ascending(remaining_cells(world, body.body));
  const std::vector<std::int32_t> left = ascending(body.cells);
  if (!std::ranges::includes(now, left)) {
    throw ParameterError("the snapshot has cells of body \"" + body.body +
                         "\" that the world has not (any more); restore it in a simulation of the same "
                         "scene from which no cell was removed.");
  }
  std::vector<std::int32_t> removed;
  std::ranges::set_difference(now, left, std::back_inserter(removed));
  return removed;
}

/// The world without the cells that edits took: all of a body at once, which gives the same numbers as one
/// edit after the other. Null when there were no edits.
std::shared_ptr<const World> edited(const World& world, const std::vector<Snapshot::BodyCells>& bodies) {
  std::shared_ptr<const World> result;
  State places = world.rest_state();
  for (const Snapshot::BodyCells& body : bodies) {
    const World& now = result == nullptr ? world : *result;
    const std::vector<std::int32_t> removed = removed_cells(now, body);
    if (removed.empty()) continue;
    check_count("numbers of loose nodes", body.places.size(), 3 * body.loose_nodes.size());
    const Body& on = now.body(body.body);
    for (std::size_t i = 0; i < body.loose_nodes.size(); ++i) {
      const std::int32_t node = body.loose_nodes[i];
      if (node < 0 || node >= on.node_count) {
        throw ParameterError("the snapshot holds node " + std::to_string(node) + " of body \"" + on.name +
                             "\", which has " + std::to_string(on.node_count) + " nodes.");
      }
      block(Reals(places.positions), on.first_node + node) =
          block(ConstReals(body.places), static_cast<std::int32_t>(i));
    }
    result = remove_cells(now, places, body.body, removed);
  }
  return result;
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
  result.integrator = integrator_->memory();
  if (watch_) result.energy_watch = watch_->reference(state_);
  if (world_->description() == nullptr) return result;
  for (const Body& body : world_->bodies()) {
    LooseNodes loose = loose_nodes(*world_, body.name);
    result.bodies.push_back(
        {body.name, remaining_cells(*world_, body.name), std::move(loose.nodes), std::move(loose.places)});
  }
  return result;
}

void Simulation::restore(const Snapshot& snapshot) {
  const std::size_t size = world_->rest_positions().size();
  check_count("positions", snapshot.state.positions.size(), size);
  check_count("velocities", snapshot.state.velocities.size(), size);
  check_count("velocities before its latest step", snapshot.velocities_before.size(), size);
  check_count("rotations", snapshot.state.rotations.size(), world_->frames().size());
  check_count("numbers of the watch on energy", snapshot.energy_watch.size(),
              watch_ ? EnergyWatch::kReferences : 0);
  check_count("edited bodies", snapshot.bodies.size(),
              world_->description() == nullptr ? 0 : world_->bodies().size());
  std::shared_ptr<const World> left = edited(*world_, snapshot.bodies);
  const World& world = left == nullptr ? *world_ : *left;
  check_memory(world, snapshot.state);
  if (left != nullptr) replace_world(std::move(left));
  state_ = snapshot.state;
  last_good_ = snapshot.state;
  last_good_.time = snapshot.time_before;
  last_good_.velocities = snapshot.velocities_before;
  held_ = snapshot.state.velocities;
  if (watch_) watch_->restore(snapshot.energy_watch, state_);
  settled_ = snapshot.settled;
  integrator_->restore(snapshot.integrator);
  forget_solves();
}

}  // namespace tissu
