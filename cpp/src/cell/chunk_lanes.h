#pragma once

/// How the elements of one chunk stand in its lanes.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/cell/element_order.h"

namespace tissu {

inline std::int32_t groups_for(std::size_t elements) {
  return (static_cast<std::int32_t>(elements) + ElementOrder::kLanes - 1) / ElementOrder::kLanes;
}

/// Lanes of a group take elements far apart in their chunk, so that they seldom share a node and the sums of
/// one lane do not wait for those of the lane before. Writes whole groups from the group `first` on.
void lay_lanes(std::span<const std::int32_t> elements, std::int32_t first, ElementOrder& order);

/// The nodes of the elements of the groups from `begin` to before `end`, ascending; each element gets its
/// nodes' places among them.
std::vector<std::int32_t> lay_places(std::span<const std::int32_t> cells, int size, std::int32_t begin,
                                     std::int32_t end, ElementOrder& order);

/// Chunks in the order of their colours, those of one colour as they are.
void sort_by_colour(const std::vector<std::int32_t>& colour, ElementOrder& order);

/// Lists the nodes of each chunk, and gives each element its nodes' places among them.
void pack_nodes(std::span<const std::int32_t> cells, int size, ElementOrder& order);

}  // namespace tissu
