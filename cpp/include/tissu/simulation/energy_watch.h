#pragma once

#include <string>

#include "tissu/step/state_mark.h"
#include "tissu/world/world.h"

namespace tissu {

struct Energy {
  double kinetic = 0.0;
  double elastic = 0.0;
  double potential = 0.0;  ///< of gravity and loads
  [[nodiscard]] double total() const { return kinetic + elastic + potential; }
};

Energy energy_of(const World& world, const State& state, Scratch& scratch);

/// Watches the energy of a scene in which nothing can add any: no led nodes, no links, no pressure, no load
/// that changes with time, no material that remembers, no frames. An undamped method that gives a moving body
/// more energy than it had is not stable there, however well its steps converge.
class EnergyWatch {
 public:
  /// Whether energy can only be kept or lost in that world.
  static bool can_watch(const World& world);

  /// Before and after a step. What is written into the state between two steps does not count.
  void begin(const World& world, const State& state);
  void end(const World& world, const State& state);
  /// The energy gained since the first step over the largest kinetic and elastic energy before it grew.
  [[nodiscard]] double growth() const { return largest_ > 0.0 ? gained_ / largest_ : 0.0; }

  static constexpr double kReported = 0.1;  ///< growth above which a step is reported as not converged, …
  static constexpr double kRefused = 10.0;  ///< … and above which the simulation has diverged
  /// A sentence for a growth above the share that is reported.
  [[nodiscard]] std::string say() const;

 private:
  Scratch scratch_;
  StateMark end_;       ///< of the latest step
  double total_ = 0.0;  ///< energy there, or at the start of this one
  double gained_ = 0.0;
  double largest_ = 0.0;
};

}  // namespace tissu
