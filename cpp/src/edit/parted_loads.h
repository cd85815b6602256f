#pragma once

/// Dead loads of a body whose nodes part.

#include <vector>

#include "tissu/world/description.h"

namespace tissu {

/// Gives the load of a node to those of it and its copies that have its material; several share it as they
/// share the mass now, whatever earlier edits of the body were. Loads on faces act on what is left of these.
void part_loads(std::vector<LoadDescription>& loads, const BodyDescription& body);

}  // namespace tissu
