#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

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

/// The nodes of a body that no cell uses, and where the world holds them.
struct LooseNodes {
  std::vector<std::int32_t> nodes;  ///< numbers in the body
  std::vector<double> places;       ///< [m], three for each
};
LooseNodes loose_nodes(const World& world, std::string_view body);

}  // namespace tissu
