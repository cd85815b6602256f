#pragma once

#include "tissu/step/bdf2_history.h"

namespace tissu {

/// The backward differentiation formula of second order (Curtiss, Hirschfelder 1952), for steps that may
/// change: 3 x1 - 4 x0 + x-1 = 2 h v1, the same for v and M^-1 f. Damps fast vibrations. A
/// step in which a free rigid body strikes something, and the one after it, are of backward Euler: velocities
/// of before a blow would throw it back. So is a step in which one turns by more than 1e-3 rad.
class Bdf2 final : public Integrator {
 public:
  explicit Bdf2(NewtonSettings newton = {}) : solver_(newton, {.held = 1.0, .free = 0.1}) {}
  [[nodiscard]] std::string_view name() const override { return "BDF2"; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  bool follow_edit(std::span<const std::int32_t> rows) override {
    solver_.follow_edit(rows);
    return true;
  }
  void prepare_ahead(const State& state, double h) override;
  void take_part(bool early, double share) override { solver_.take_part(early, share); }
  StepReport step(State& state, double h) override;
  void append_memory(std::vector<double>& memory) const override { history_.append_memory(memory); }
  void restore(ConstReals memory) override { history_.restore(memory); }
  void before_edit() override { solver_.count_parts(); }
  /// Parts that were one go on from their own velocities: with what they were before, one would push the
  /// other.
  void after_edit() override {
    if (solver_.came_apart()) history_.forget();
  }
  void copy_rows(std::span<const RowCopy> copies) override { history_.copy_rows(copies); }
  void blend_rows(std::span<const RowBlend> blends) override { history_.blend_rows(blends); }

 private:
  void solve_anew(State& state, double h, StepReport& report);

  StageSolver solver_;
  Bdf2History history_;
  State start_;
  std::vector<double> v_;
};

}  // namespace tissu
