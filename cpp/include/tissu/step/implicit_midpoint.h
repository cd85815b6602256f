#pragma once

#include "tissu/step/stage.h"

namespace tissu {

/// Implicit midpoint rule: M (v1 - v0) = h f((x0 + x1) / 2, (v0 + v1) / 2), x1 = x0 + h (v0 + v1) / 2. Of
/// second order; keeps linear and angular momentum, and the energy of linear systems.
class ImplicitMidpoint final : public Integrator {
 public:
  explicit ImplicitMidpoint(NewtonSettings newton = {}) : solver_(newton, {.held = 0.1, .free = 0.1}) {}
  [[nodiscard]] std::string_view name() const override { return "implicit midpoint"; }
  [[nodiscard]] bool is_undamped() const override { return true; }
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
  std::vector<double> mean_;  ///< velocity
};

}  // namespace tissu
