#pragma once

#include <vector>

#include "tissu/force/force_model.h"

namespace tissu {

/// f = m g for every node and frame, times the share of the loads that acts.
class Gravity final : public ForceModel {
 public:
  Gravity(std::vector<double> masses, Vec3 acceleration);
  [[nodiscard]] std::string_view effect() const override { return "gravity"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  [[nodiscard]] bool has_constant_stiffness() const override { return true; }
  [[nodiscard]] bool has_stiffness() const override { return false; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  /// -sum f . x, zero for a body at the origin [J]
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;
  /// After an edit in place: what it pulls at [kg].
  void set_mass(std::int32_t row, double mass) { masses_[static_cast<std::size_t>(row)] = mass; }
  [[nodiscard]] const Vec3& acceleration() const { return acceleration_; }

 private:
  std::vector<double> masses_;
  Vec3 acceleration_;  ///< [m/s2]
};

}  // namespace tissu
