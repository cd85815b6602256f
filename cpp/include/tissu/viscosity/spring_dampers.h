#pragma once

/// A damper beside each spring, Kelvin–Voigt for the model mass-spring: f = -c n (n . (v_b - v_a)), n the
/// direction of the spring, c = eta_E sum_e V_e / l0^2 [N s/m] by the rule of its stiffness. eta_E is the
/// viscosity of traction with free sides, eta (3 zeta + 2 eta) / (zeta + eta), as E follows from Lamé's
/// constants. Turning is free; df/dv is exact, and the change of n with x is left out of df/dx.

#include "tissu/law/law.h"
#include "tissu/model/body_model.h"

namespace tissu {

class SpringDampers final : public ForceModel {
 public:
  /// `springs` outlives it; `viscosity` holds zeta and eta in the places of lambda and mu.
  SpringDampers(const DampedSprings& springs, Lame viscosity);
  [[nodiscard]] std::string_view effect() const override { return "Kelvin–Voigt viscosity"; }
  [[nodiscard]] bool may_drive_turns() const override { return true; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;

 private:
  const DampedSprings& springs_;
  AlignedVector<double> damping_;  ///< c, [group][8]
};

}  // namespace tissu
