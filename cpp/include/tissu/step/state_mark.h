#pragma once

#include "tissu/state/row_blend.h"
#include "tissu/state/state.h"

namespace tissu {

/// Refuses what an integrator kept in another world: its numbers are copied by their places.
void require_memory(std::size_t found, std::size_t accepted);

/// Tells whether a state is the one that a step left behind: methods that keep something from step to step
/// begin anew when somebody has moved the bodies in between.
class StateMark {
 public:
  void set(const State& state);
  void forget() { positions_.clear(); }
  void copy_rows(std::span<const RowCopy> copies);
  void blend_rows(std::span<const RowBlend> blends);
  [[nodiscard]] bool is_empty() const { return positions_.empty(); }
  [[nodiscard]] bool is(const State& state) const;
  /// Time, positions, velocities, …
  void append_to(std::vector<double>& memory) const;
  /// … and back; what follows them.
  ConstReals take_from(ConstReals memory, std::size_t size);

 private:
  double time_ = 0.0;
  std::vector<double> positions_;
  std::vector<double> velocities_;
};

}  // namespace tissu
