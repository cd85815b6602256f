#pragma once

#include "tissu/step/anderson.h"
#include "tissu/step/bdf2_history.h"

namespace tissu {

/// BDF2 by Banach's fixed-point iteration (Chendeb 2007, section 2.4.4), without any matrix:
/// v <- v^ + a M^-1 f(x(v), v). It contracts only while h^2 omega^2 < 9/4, omega the largest
/// eigenfrequency; Anderson's acceleration goes beyond.
class Bdf2FixedPoint final : public Integrator {
 public:
  struct Settings {
    int iterations = 50;
    double tolerance = 1e-6;  ///< on the norm of the residual, relative to what acts at the guess
    int anderson = 0;         ///< differences that Anderson's acceleration keeps; 0: without
  };
  explicit Bdf2FixedPoint(Settings settings);
  [[nodiscard]] std::string_view name() const override;
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
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
  /// False: it does not contract.
  bool iterate(State& state, StepReport& report);
  [[noreturn]] void refuse(double h) const;

  Settings settings_;
  StageSolver solver_;
  Bdf2History history_;
  Anderson anderson_;
  State start_;
  std::vector<double> v_;
  std::vector<double> change_;
  std::vector<double> weight_;  ///< mass of each degree of freedom
};

}  // namespace tissu
