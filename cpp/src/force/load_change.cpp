#include "tissu/force/load_change.h"

#include <string>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/base/error.h"

namespace tissu {

double History::at(double time) const { return interpolate(times, factors, time, 1.0); }

void LoadChange::claim(std::string_view load, std::size_t values, MemoryPlaces& places) {
  place_ = places.claim(std::string(load), 0);
  count_ = kHead + values;
}

bool LoadChange::is_there(const State& state) const {
  return place_ < state.memory.size() && !state.memory[place_].empty();
}

const double* LoadChange::values(const State& state) const {
  return is_there(state) ? state.memory[place_].data() + kHead : nullptr;
}

double LoadChange::factor(const State& state, const History& history) const {
  if (!is_there(state) || state.memory[place_][0] == 0.0) return history.at(state.time);
  return state.memory[place_][1];
}

void LoadChange::carry(const LoadChange& before, const Memory& then, Memory& now) const {
  if (before.count_ == count_) now[place_] = then[before.place_];
}

void LoadChange::check(std::string_view load, const State& state) const {
  const std::size_t found = state.memory[place_].size();
  if (found == 0 || found == count_) return;
  throw ParameterError("found " + std::to_string(found) + " numbers of " + std::string(load) + "; " +
                       std::to_string(count_) + " are accepted, or none.");
}

}  // namespace tissu
