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

/// How the supports of a part move.
struct Carried {
  Vec3 velocity = Vec3::Zero();  ///< [m/s] the mean of its held nodes, for each axis on its own
  double spread = 0.0;           ///< [m/s] the largest distance of one from it
};
/// `velocities` has those of the supports in held rows.
Carried carried(const World& world, const ConnectedPart& part, ConstReals velocities);

/// All parts of a world, by their first node.
std::vector<ConnectedPart> parts_of(const World& world);

}  // namespace tissu
