#pragma once

#include "tissu/step/stage.h"
#include "tissu/step/state_mark.h"

namespace tissu {

/// Newmark's method: x1 = x0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1), v1 = v0 + h ((1 - gamma) a0 + gamma
/// a1), M a1 = f(x1, v1). Of second order for gamma = 1/2; a larger gamma damps fast vibrations.
/// Unconditionally stable for linear systems while 2 beta >= gamma >= 1/2.
class Newmark final : public Integrator {
 public:
  struct Settings {
    double beta = 0.25;
    double gamma = 0.5;
    NewtonSettings newton;
  };
  explicit Newmark(Settings settings);
  [[nodiscard]] std::string_view name() const override { return "Newmark"; }
  [[nodiscard]] bool is_undamped() const override { return gamma_ == 0.5; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  /// The acceleration is found anew, of the forces that are left.
  void after_edit() override { end_.forget(); }
  bool follow_edit(std::span<const std::int32_t> rows) override {
    solver_.follow_edit(rows);
    return true;
  }
  void take_part(bool early, double share) override { solver_.take_part(early, share); }
  StepReport step(State& state, double h) override;
  void append_memory(std::vector<double>& memory) const override;
  void restore(ConstReals memory) override;
  void copy_rows(std::span<const RowCopy> copies) override;
  void blend_rows(std::span<const RowBlend> blends) override;

 private:
  /// The accelerations at the start: those that the last step ended with, or M^-1 f when the state is
  /// another.
  void find_acceleration(const State& state);

  double beta_;
  double gamma_;
  StageSolver solver_;
  State start_;
  std::vector<double> v_;
  std::vector<double> a_;
  StateMark end_;  ///< of the last step
};

}  // namespace tissu
