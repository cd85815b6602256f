#pragma once

#include <string_view>

#include "tissu/world/world.h"

namespace tissu {

/// What a body of the world was built from; refuses a world that was not compiled for editing.
const BodyDescription& described(const World& world, std::string_view name);

}  // namespace tissu
