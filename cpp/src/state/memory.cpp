#include "tissu/state/memory.h"

#include <algorithm>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {

std::size_t MemoryPlaces::claim(std::string name, std::size_t reals) {
  places_.push_back({std::move(name), reals});
  return places_.size() - 1;
}

std::size_t MemoryPlaces::find(std::string_view name) const {
  const auto found = std::ranges::find(places_, name, &Place::name);
  if (found != places_.end()) return static_cast<std::size_t>(found - places_.begin());
  throw ParameterError("nothing in this world remembers \"" + std::string(name) +
                       "\"; ask for it in the description of the world.");
}

Memory MemoryPlaces::at_rest() const {
  Memory memory;
  memory.reserve(places_.size());
  for (const Place& place : places_) memory.emplace_back(place.reals, 0.0);
  return memory;
}

}  // namespace tissu
