#pragma once

/// The verbs of a running world, each over those of its models that have it and its live supports.

#include <string_view>
#include <vector>

#include "tissu/world/world.h"

namespace tissu {

/// Once a step of h [s], before anything reads the state.
void begin_step(const World& world, State& state, Scratch& scratch, double h);
/// Models that remember write into the memory what the step that led here adds to it.
void remember(const World& world, State& state);
/// The memory of a state of the world before an edit becomes one of the world after it.
void carry_memory(const World& before, const World& after, State& state);
/// Refuses a memory that is not of this world.
void check_memory(const World& world, const State& state);
/// What a state remembers under a name; refuses a name that the world does not know.
std::vector<double>& memory_of(const World& world, State& state, std::string_view name);

}  // namespace tissu
