#include "tissu/step/state_mark.h"

#include <string>

#include "tissu/base/error.h"

namespace tissu {

void require_memory(std::size_t found, std::size_t accepted) {
  if (found == accepted) return;
  throw ParameterError("the snapshot has " + std::to_string(found) + " numbers of the integrator where " +
                       std::to_string(accepted) +
                       " are accepted; restore it in the world that it was taken from.");
}

void StateMark::set(const State& state) {
  time_ = state.time;
  positions_ = state.positions;
  velocities_ = state.velocities;
}

void StateMark::copy_rows(std::span<const RowCopy> copies) {
  if (is_empty()) return;
  tissu::copy_rows(copies, positions_);
  tissu::copy_rows(copies, velocities_);
}

void StateMark::blend_rows(std::span<const RowBlend> blends) {
  if (is_empty()) return;
  tissu::blend_rows(blends, positions_);
  tissu::blend_rows(blends, velocities_);
}

bool StateMark::is(const State& state) const {
  return !positions_.empty() && time_ == state.time && positions_ == state.positions &&
         velocities_ == state.velocities;
}

void StateMark::append_to(std::vector<double>& memory) const {
  memory.push_back(time_);
  memory.insert(memory.end(), positions_.begin(), positions_.end());
  memory.insert(memory.end(), velocities_.begin(), velocities_.end());
}

ConstReals StateMark::take_from(ConstReals memory, std::size_t size) {
  time_ = memory.front();
  const ConstReals positions = memory.subspan(1, size);
  const ConstReals velocities = memory.subspan(1 + size, size);
  positions_.assign(positions.begin(), positions.end());
  velocities_.assign(velocities.begin(), velocities.end());
  return memory.subspan(1 + 2 * size);
}

}  // namespace tissu
