#pragma once

#include <string_view>

#include "tissu/force/force_model.h"

namespace tissu {

/// What instruments remember from step to step: where they were, and where that is in the material. They give
/// no force by themselves; what cuts with them reads and writes this between two steps.
///
/// A track for each instrument and body, one after the other: number, length, incision (-1: none), points of
/// the edge, poses and rows; seven numbers for each pose, place [m] and unit quaternion w x y z; twelve for
/// each point of each row: whether it is in the material, four rows of the unknown (-1: none), their weights,
/// and the offset from there [m].
class Instruments final : public ForceModel {
 public:
  static constexpr std::string_view kMemory = "instruments";  ///< name of their place in the memory
  static constexpr std::size_t kHead = 6;
  static constexpr std::size_t kPose = 7;
  static constexpr std::size_t kAnchor = 12;

  [[nodiscard]] std::string_view effect() const override { return "instruments"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  [[nodiscard]] bool has_constant_stiffness() const override { return true; }
  [[nodiscard]] bool has_stiffness() const override { return false; }
  void add_force(const State& /*state*/, Scratch& /*scratch*/, Reals /*f*/) const override {}

  void claim_memory(MemoryPlaces& places) override;
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  /// Refuses tracks that cannot be read.
  void check_memory(const State& state) const override;

 private:
  std::size_t place_ = 0;  ///< in State::memory
};

}  // namespace tissu
