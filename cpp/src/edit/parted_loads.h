#pragma once

/// Nodal loads of a body whose nodes part.

#include <vector>

#include "tissu/world/description.h"

namespace tissu {

/// Gives the load of a node to those of it and its copies that have its material; several share it as they
/// share the mass. `copied` are the nodes that the body's last nodes copy.
void part_loads(WorldDescription& description, const BodyDescription& body,
                const std::vector<std::int32_t>& copied);

}  // namespace tissu
