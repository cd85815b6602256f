#pragma once

/// Nodes of a body that no cell uses any more.

#include <span>
#include <string_view>
#include <vector>

#include "tissu/state/state.h"
#include "tissu/world/description.h"

namespace tissu {

/// What every edit begins with: cells are numbered through the blocks of a body, of which each keeps its own
/// list from the first edit on, and every cell is heir of itself.
void number_cells(BodyDescription& body);

/// Which nodes of the body a cell uses.
std::vector<char> used_nodes(const BodyDescription& body);

/// Refuses an edit that parts nodes of a body, or takes their last cell, where tissue is tied to them.
void refuse_tied(const WorldDescription& description, std::string_view body,
                 std::span<const std::int32_t> nodes);

/// Holds the nodes of the body that no cell uses where they are; nothing else leads them any more.
void hold_debris(WorldDescription& description, const BodyDescription& body, const State& state,
                 std::int32_t first_node);

}  // namespace tissu
