#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "tissu/state/state.h"
#include "tissu/world/world.h"

namespace tissu {

/// A new world without some cells of a body, by their numbers in it. Nodes that no cell uses any more stay
/// where the state has them. Refuses a world that was not compiled for editing, and numbers that are not
/// there.
std::shared_ptr<const World> remove_cells(const World& world, const State& state, std::string_view body,
                                          std::span<const std::int32_t> cells);

/// Numbers, in the body as it was first built, of the cells that are still there.
std::vector<std::int32_t> remaining_cells(const World& world, std::string_view body);

}  // namespace tissu
