#pragma once

/// Connected parts of bodies.

#include <cstdint>
#include <vector>

#include "tissu/world/world.h"

namespace tissu {

/// Nodes that cells join: a body, a piece that a cut made of it, or bodies that share frames.
struct ConnectedPart {
  std::vector<std::int32_t> nodes;   ///< with mass, ascending
  std::vector<std::int32_t> frames;  ///< the numbers of those of its nodes that have a rotation
  double mass = 0.0;                 ///< [kg]
  bool is_held = false;              ///< at some node or rotation
};

/// All parts of a world, by their first node.
std::vector<ConnectedPart> parts_of(const World& world);

}  // namespace tissu
