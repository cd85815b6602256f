#include "tissu/world/run_time.h"

#include <string>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {

void begin_step(const World& world, State& state, Scratch& scratch, double h) {
  for (const ForceModel* model : world.run_time().beginning) model->begin_step(state, scratch, h);
  world.fixed().begin_step(state, h);
}

void remember(const World& world, State& state) {
  if (world.run_time().remembering.empty()) return;
  for (const ForceModel* model : world.run_time().remembering) model->remember(state);
  state.memory_time = state.time;
}

void carry_memory(const World& before, const World& after, State& state) {
  if (after.memory().count() == 0) return;
  Memory memory = after.memory().at_rest();
  for (const auto& model : after.forces()) {
    for (const auto& then : before.forces()) model->carry_memory(*then, state.memory, memory);
  }
  after.fixed().carry_memory(before.fixed(), state.memory, memory);
  state.memory = std::move(memory);
}

void check_memory(const World& world, const State& state) {
  if (state.memory.size() != world.memory().count()) {
    throw ParameterError("the state has " + std::to_string(state.memory.size()) +
                         " lists of what models remember where the world has " +
                         std::to_string(world.memory().count()) +
                         "; restore it in the world that it was taken from.");
  }
  for (const auto& model : world.forces()) model->check_memory(state);
  world.fixed().check_memory(state);
}

std::vector<double>& memory_of(const World& world, State& state, std::string_view name) {
  return state.memory[world.memory().find(name)];
}

}  // namespace tissu
