#pragma once

#include "tissu/step/explicit_method.h"

namespace tissu {

/// Forward Euler: x1 = x0 + h v0, v1 = v0 + h M^-1 f(x0, v0). Of first order. Makes every vibration grow that
/// is not damped enough: by sqrt(1 + h^2 omega^2) a step without damping.
class ExplicitEuler final : public ExplicitMethod {
 public:
  [[nodiscard]] std::string_view name() const override { return "explicit Euler"; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;

 protected:
  [[nodiscard]] Amplification amplification() const override;
  void advance(State& state, double h) override;

 private:
  std::vector<double> a_;
};

/// Symplectic Euler: v1 = v0 + h M^-1 f(x0, v0), x1 = x0 + h v1. Of first order; its energy does not drift.
/// Stable while h^2 omega^2 + 2 h c < 4, c the largest damping.
class SymplecticEuler final : public ExplicitMethod {
 public:
  [[nodiscard]] std::string_view name() const override { return "symplectic Euler"; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;

 protected:
  [[nodiscard]] Amplification amplification() const override;
  void advance(State& state, double h) override;

 private:
  std::vector<double> a_;
};

}  // namespace tissu
