#pragma once

#include <memory>
#include <vector>

#include "tissu/step/integrator.h"
#include "tissu/step/system.h"

namespace tissu {

/// Backward Euler: M (v1 - v0) = h f(x0 + h v1, v1), x1 = x0 + h v1.
///
/// Linearised once: (M - h D - h^2 K) dv = h (f0 + h K v0), K = df/dx, D = df/dv. With more Newton iterations
/// the equation itself is solved, with line search where whole steps fail.
class ImplicitEuler final : public Integrator {
 public:
  explicit ImplicitEuler(NewtonSettings newton = {});
  [[nodiscard]] std::string_view name() const override { return "implicit Euler"; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  StepReport step(State& state, double h) override;

 private:
  void first_solve(double h, StepReport& report);
  void newton(State& state, double h, StepReport& report);
  enum class LineSearch { off, on };
  /// Newton's iteration: with whole steps, which may pass through worse states on the way to a better one, or
  /// with steps that are halved until the residual falls. True when it converged.
  bool iterate(State& state, double h, LineSearch search, StepReport& report);
  /// residual_ = h f - M (v - v0) at x0 + h v; its norm.
  double residual(State& state, double h, ConstReals v);

  NewtonSettings newton_;
  std::unique_ptr<System> system_;
  State start_;
  std::vector<double> v_;
  std::vector<double> first_;
  std::vector<double> trial_;
  std::vector<double> change_;
  std::vector<double> right_;
  std::vector<double> work_;
  double reference_ = 0.0;  ///< h |external force|
};

}  // namespace tissu
