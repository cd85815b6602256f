#pragma once

/// Which nodes of a body a cut may move.

#include <string_view>

#include "tissu/edit/cut/snap.h"
#include "tissu/state/state.h"
#include "tissu/world/world.h"

namespace tissu {

/// Nodes whose cells are of one law and density, that nothing holds, leads or loads, and to which no tissue
/// is tied. Under a pressure on the body nodes on its surface stay too, and in a body that remembers all do.
/// Moves are refused that change the elastic energy of the cells around the node by more than 1 %. `hosts`:
/// of the body.
SnapRules snap_rules(const World& world, const State& state, std::string_view body, const Hosts& hosts);

}  // namespace tissu
