#pragma once

/// Kelvin–Voigt: a damper beside the law at every point of every cell, lines and sheets too,
///
///     S_v = 2 eta dE/dt + zeta tr(dE/dt) I,   f_a = -sum_g w_g F S_v grad_a
///
/// [Pa] of viscosities [Pa s]. No motion of the whole body is damped, turning included. df/dv is symmetric
/// and never positive. The change of f with x at the same v is left out of df/dx, as Rayleigh's is: it
/// vanishes with the speed, and implicit Euler solves for the speed at the end of the step all the same.
///
/// Where nothing holds a sheet across, zeta becomes 2 zeta eta / (zeta + 2 eta); along a line, 2 eta + zeta
/// becomes eta (3 zeta + 2 eta) / (zeta + eta), as Lamé's constants do.

#include "tissu/viscosity/viscous_cells.h"

namespace tissu {

class KelvinVoigt final : public ViscousCells {
 public:
  /// On the cells of `block`; `viscosity` holds zeta and eta in the places of lambda and mu.
  KelvinVoigt(const ElasticBlock& block, Lame viscosity, ConstReals rest_positions, Isa isa, Threads threads);
  [[nodiscard]] std::string_view effect() const override { return "Kelvin–Voigt viscosity"; }
  [[nodiscard]] bool may_drive_turns() const override { return true; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;

 private:
  /// Their product and stiffness are those of df/dv.
  [[nodiscard]] Loops<ElasticKernels, ElasticView> loops() const;

  const ElasticKernels* kernels_;
  const LawKernels* law_;
};

}  // namespace tissu
