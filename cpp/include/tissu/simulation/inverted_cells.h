#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tissu/world/world.h"

namespace tissu {

/// Numbers of the cells of a body that are inside out, ascending. A volume cell is when det F <= 0 at a point
/// of its quadrature, where its law is evaluated, or at one of the element's full rule. Of cells whose points
/// are not their own (frames) and of thin ones the mean det F counts.
std::vector<std::int32_t> inverted_cells(const World& world, const State& state, const Body& body);

/// A sentence on the cells of all bodies that are inside out; empty where there are none.
std::string say_inverted(const World& world, const State& state);

}  // namespace tissu
