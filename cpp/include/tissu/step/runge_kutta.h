#pragma once

#include "tissu/step/explicit_method.h"

namespace tissu {

/// Runge's and Kutta's explicit methods of second order (the midpoint rule) and of fourth (the classical
/// one). The second makes undamped vibrations grow, by 1 + (h omega)^4 / 8 a step; the fourth damps them
/// while h omega < 2 sqrt(2). Of first order where surfaces meet.
class RungeKutta final : public ExplicitMethod {
 public:
  /// `order` is 2 or 4.
  explicit RungeKutta(int order);
  [[nodiscard]] std::string_view name() const override;
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;

 protected:
  [[nodiscard]] Amplification amplification() const override;
  [[nodiscard]] bool has_stages() const override { return true; }
  void advance(State& state, double h) override;

 private:
  int order_;
  State stage_;
  std::vector<double> a_;
  std::vector<double> v_;
  std::vector<double> velocity_;      ///< weighted sum of those of the stages
  std::vector<double> acceleration_;  ///< the same
};

}  // namespace tissu
