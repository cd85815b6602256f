#pragma once

/// What a run has changed of a load: numbers in the memory of a state, none where nothing has been changed.

#include <string_view>

#include "tissu/state/state.h"

namespace tissu {

/// A factor over time, linear between its times and held at its ends; 1 when it has no times.
struct History {
  std::vector<double> times;  ///< ascending [s]
  std::vector<double> factors;
  [[nodiscard]] double at(double time) const;
};

/// The place of a load in the memory. Its numbers are: whether a factor is given from now on (1 or 0), that
/// factor, and then `values` numbers that the load is made of.
class LoadChange {
 public:
  static constexpr std::size_t kHead = 2;

  void claim(std::string_view load, std::size_t values, MemoryPlaces& places);
  /// The load is made of other numbers from now on.
  void resize(std::size_t values) { count_ = kHead + values; }
  /// Null: the load is as the scene has it.
  [[nodiscard]] const double* values(const State& state) const;
  /// The factor given from now on, else that of the history.
  [[nodiscard]] double factor(const State& state, const History& history) const;
  void carry(const LoadChange& before, const Memory& then, Memory& now) const;
  /// Refuses a memory of another length.
  void check(std::string_view load, const State& state) const;

 private:
  [[nodiscard]] bool is_there(const State& state) const;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t place_ = kNone;
  std::size_t count_ = 0;  ///< numbers of a load that was changed
};

}  // namespace tissu
