#pragma once

#include "tissu/step/stage.h"

namespace tissu {

/// Backward Euler: M (v1 - v0) = h f(x0 + h v1, v1), x1 = x0 + h v1. Of first order.
///
/// Linearised once: (M - h D - h^2 K) dv = h (f0 + h K v0), K = df/dx, D = df/dv. With more Newton iterations
/// the equation itself is solved.
class ImplicitEuler final : public Integrator {
 public:
  explicit ImplicitEuler(NewtonSettings newton = {})
      : solver_(newton, {.held = 3.0, .free = 0.1}, EnergyLaw::falls) {}
  [[nodiscard]] std::string_view name() const override { return "implicit Euler"; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  bool follow_edit(std::span<const std::int32_t> rows) override {
    solver_.follow_edit(rows);
    return true;
  }
  void prepare_ahead(const State& state, double h) override;
  void take_part(bool early, double share) override { solver_.take_part(early, share); }
  StepReport step(State& state, double h) override;

 private:
  void begin(const State& state, double h);

  StageSolver solver_;
  State start_;
  std::vector<double> v_;
};

}  // namespace tissu
