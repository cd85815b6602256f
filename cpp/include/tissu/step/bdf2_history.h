#pragma once

#include "tissu/step/stage.h"
#include "tissu/step/state_mark.h"

namespace tissu {

/// The state before the last one, which BDF2 needs; known only when the last step led to the present state.
class Bdf2History {
 public:
  void prepare(const World& world);
  /// Makes the stage of a step of h from `start`: with r = h / (step before), s = r^2 / (1 + 2 r),
  /// x1 = x0 + s (x0 - x-1) + a v1, v1 = v0 + s (v0 - v-1) + a M^-1 f(x1, v1), a = h (1 + r) / (1 + 2 r);
  /// r = 1 gives 4/3, -1/3, 2/3. Without history the step is one of backward
  /// Euler, as is one that is more than 1 + sqrt(2) times as long as the one before, with contact 1.5 times.
  void begin(const State& start, double h, StageSolver& solver);
  /// The latest stage goes on from the state before the last one.
  [[nodiscard]] bool goes_on() const { return goes_on_; }
  /// Angular velocities of the latest solution become those of its momenta in the rotations of the base.
  void keep_momenta(const StageSolver& solver, State& state) const;
  /// The next stage is one of backward Euler.
  void forget() { end_.forget(); }
  /// The step of h from `start` led to `end`.
  void keep(const State& start, double h, const State& end);

  void append_memory(std::vector<double>& memory) const;
  void restore(ConstReals memory);
  void copy_rows(std::span<const RowCopy> copies);
  void blend_rows(std::span<const RowBlend> blends);

 private:
  void turn_inertia(const World& world, Stage& stage);

  State before_;
  double step_ = 0.0;
  bool goes_on_ = false;
  StateMark end_;
  std::vector<double> way_;
  std::vector<Vec3>
      shifts_;          ///< of frames: angular velocities of the base with its inertia, less those given
  State extrapolated_;  ///< the state before, in the rotations of the base
};

}  // namespace tissu
