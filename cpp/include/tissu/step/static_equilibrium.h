#pragma once

#include <memory>
#include <vector>

#include "tissu/step/integrator.h"
#include "tissu/step/system.h"

namespace tissu {

/// Equilibrium without inertia: f(x) = 0 by Newton's method, with line search where whole steps fail. The
/// external loads of the first step, and the way of led nodes in every step, are applied in `load_steps`
/// parts; a part that does not converge is halved.
class StaticEquilibrium final : public Integrator {
 public:
  struct Settings {
    NewtonSettings newton{50, 1e-9};
    int load_steps = 1;
  };
  explicit StaticEquilibrium(Settings settings);
  [[nodiscard]] std::string_view name() const override { return "static equilibrium"; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  StepReport step(State& state, double h) override;
  /// One number: whether the external loads act in full already.
  [[nodiscard]] std::vector<double> memory() const override { return {loaded_ ? 1.0 : 0.0}; }
  void restore(ConstReals memory) override { loaded_ = !memory.empty() && memory[0] != 0.0; }

 private:
  /// Newton from the present state, led nodes going `share` of their way first; true when it converged.
  bool equilibrate(State& state, double share, StepReport& report);
  enum class LineSearch { off, on };
  /// Newton's iteration: with whole steps, which may pass through worse states on the way to a better one, or
  /// with steps that are halved until the residual falls.
  bool iterate(State& state, double share, LineSearch search, StepReport& report);
  /// Moves by change_, halved until the residual is below `below`; the residual.
  double go(State& state, double below);
  double residual(const State& state);

  Settings settings_;
  bool loaded_ = false;
  std::unique_ptr<System> system_;
  State before_;  ///< of the part of the load
  State from_;    ///< of the Newton step
  std::vector<double> change_;
  std::vector<double> right_;
  std::vector<double> work_;
};

}  // namespace tissu
