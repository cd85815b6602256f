#include "culprit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr double kSqueezed = 0.5;  ///< of a cell's volume

std::int32_t number_of(const BodyModel& model, std::int32_t first, std::size_t cell) {
  const auto& numbers = model.block().cell_numbers;
  return numbers.empty() ? first + static_cast<std::int32_t>(cell) : numbers[cell];
}

/// Calls f(body, block, number of its first cell) for each block of its model.
template <class Function>
void for_blocks(const World& world, Function&& f) {
  for (const Body& body : world.bodies()) {
    std::int32_t first = 0;
    for (const BodyModel* model : body.models) {
      f(body, *model, first);
      first += model->cell_count();
    }
  }
}

/// The body's node that goes fastest, of all bodies, and its speed.
std::pair<std::int32_t, double> fastest_node(const World& world, const State& state) {
  std::vector<std::uint8_t> turns(static_cast<std::size_t>(state.blocks()), 0);
  for (const Frame& frame : world.frames()) turns[static_cast<std::size_t>(frame.rotation)] = 1;
  std::pair<std::int32_t, double> fastest{-1, 0.0};
  for (const Body& body : world.bodies()) {
    for (std::int32_t node = body.first_node; node < body.first_node + body.node_count; ++node) {
      const double speed = block(ConstReals(state.velocities), node).norm();
      if (turns[static_cast<std::size_t>(node)] == 0 && speed > fastest.second) fastest = {node, speed};
    }
  }
  return fastest;
}

}  // namespace

Culprit cell_of_node(const World& world, std::int32_t node) {
  Culprit found;
  for_blocks(world, [&](const Body& body, const BodyModel& model, std::int32_t first) {
    if (found.element >= 0) return;
    const auto& cells = model.block().cells;
    const auto at = std::ranges::find(cells, node);
    if (at == cells.end()) return;
    const auto cell =
        static_cast<std::size_t>(at - cells.begin()) / static_cast<std::size_t>(model.nodes_per_cell());
    found = {body.name, number_of(model, first, cell),
             "node " + std::to_string(node - body.first_node) + " of it was not finite or too fast", 1.0,
             node - body.first_node};
  });
  return found;
}

Culprit worst_cell(const World& world, const State& state) {
  Culprit worst;
  double smallest = std::numeric_limits<double>::infinity();
  for_blocks(world, [&](const Body& body, const BodyModel& model, std::int32_t first) {
    const CellFields fields = model.fields(state);
    for (std::size_t e = 0; e < fields.volume_ratio.size(); ++e) {
      if (!(fields.volume_ratio[e] < smallest)) continue;  // not a number either
      smallest = fields.volume_ratio[e];
      worst = {body.name, number_of(model, first, e), "its volume ratio was " + number_text(smallest),
               smallest};
    }
  });
  return worst;
}

Culprit culprit_of(const World& world, const State& state, double limit) {
  Culprit culprit;
  for (std::int32_t node = 0; node < state.blocks() && culprit.element < 0; ++node) {
    const bool sane = block(ConstReals(state.positions), node).allFinite() &&
                      block(ConstReals(state.velocities), node).cwiseAbs().maxCoeff() < limit;
    if (!sane) culprit = cell_of_node(world, node);
  }
  if (culprit.element >= 0) return culprit;
  culprit = worst_cell(world, state);
  const auto [node, speed] = fastest_node(world, state);
  if (node < 0 || culprit.volume_ratio < kSqueezed) return culprit;
  const Culprit fastest = cell_of_node(world, node);
  if (fastest.element < 0) return culprit;
  return {fastest.body, fastest.element,
          "node " + std::to_string(fastest.node) + " of it, the fastest, had " + number_text(speed) + " m/s",
          1.0, fastest.node};
}

std::string look_at(const Culprit& culprit) {
  return "look at cell " + std::to_string(culprit.element) + " of body \"" + culprit.body +
         "\": before the step " + culprit.why;
}

}  // namespace tissu
