#pragma once

/// The elastic energy of cells around nodes that move at rest.

#include <cstdint>
#include <optional>
#include <vector>

#include "tissu/base/isa.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/world/description.h"

namespace tissu {

/// Nodes of the moves, made one after the other, around which the elastic energy of the cells changes by more
/// than 1 %: x at the node's new place is read from the field before, which other nodes of the cells then
/// interpolate otherwise. Changes below the energy of a strain of 1e-6 are rounding. `x`: places now.
std::vector<std::int32_t> moves_with_a_jump(const BodyDescription& body, std::optional<Isa> isa,
                                            const Hosts& hosts, ConstReals x,
                                            const std::vector<NodeMove>& moves);

}  // namespace tissu
