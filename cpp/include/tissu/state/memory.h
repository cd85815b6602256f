#pragma once

/// What models remember from step to step. It stands in the state, so that a copy of the state holds all of
/// it: roll back, checkpoint and several states of one world need no more than that copy.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tissu {

/// A list of numbers in each place; the model that claimed the place knows how to read it. Lists of materials
/// keep their length, those of what a run adds (links) grow and shrink.
using Memory = std::vector<std::vector<double>>;

/// The places in the memory of a world's states, claimed by its models when the world is built.
class MemoryPlaces {
 public:
  /// A place of `reals` numbers, zero at rest; returns its number. Several places may have one name.
  std::size_t claim(std::string name, std::size_t reals);
  [[nodiscard]] std::size_t count() const { return places_.size(); }
  [[nodiscard]] const std::string& name(std::size_t place) const { return places_[place].name; }
  /// The first place of this name; refuses a name that no model has claimed.
  [[nodiscard]] std::size_t find(std::string_view name) const;
  /// The memory of a state at rest.
  [[nodiscard]] Memory at_rest() const;

 private:
  struct Place {
    std::string name;
    std::size_t reals;
  };
  std::vector<Place> places_;
};

}  // namespace tissu
