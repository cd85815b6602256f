#pragma once

/// What to name when a step diverges.

#include <cstdint>
#include <string>

#include "tissu/world/world.h"

namespace tissu {

/// A cell to blame for a divergence.
struct Culprit {
  std::string body;
  std::int32_t element = -1;
  std::string why;
  double volume_ratio = 1.0;  ///< of the cell, where that is why
  std::int32_t node = -1;     ///< of the body, where a node is why
};

/// The first cell that has the node.
Culprit cell_of_node(const World& world, std::int32_t node);
/// The cell that is squeezed or turned over most.
Culprit worst_cell(const World& world, const State& state);
/// The cell of the first node that is not finite or faster than `limit`, the cell that is squeezed most,
/// where it has less than half its volume, or else that of the fastest node.
Culprit culprit_of(const World& world, const State& state, double limit);
/// "look at cell 3 of body "liver": " and why; nothing where nothing was found.
std::string look_at(const Culprit& culprit);

}  // namespace tissu
