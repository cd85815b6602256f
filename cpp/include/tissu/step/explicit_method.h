#pragma once

#include <memory>
#include <vector>

#include "tissu/step/integrator.h"
#include "tissu/step/stable_step.h"
#include "tissu/step/system.h"

namespace tissu {

/// What explicit methods share: accelerations from the lumped mass, and the step that they may not exceed.
class ExplicitMethod : public Integrator {
 public:
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  /// Refuses a step above the stable one.
  StepReport step(State& state, double h) final;
  double stable_step(const State& state) override;
  void append_memory(std::vector<double>& memory) const override { stable_.append_memory(memory); }
  void restore(ConstReals memory) override { stable_.restore(memory); }

 protected:
  /// What one step does to vibrations.
  [[nodiscard]] virtual Amplification amplification() const = 0;
  /// Moves `state`, which is start(), by h.
  virtual void advance(State& state, double h) = 0;

  [[nodiscard]] const State& start() const { return start_; }
  [[nodiscard]] const World& world() const { return system_->world(); }
  /// a = M^-1 f at a state; frames with their inertia at the start.
  void acceleration(const State& state, Reals a);
  /// Puts led nodes where they are at the time of `state`, `since` after the start, with the velocity that
  /// leads there.
  void lead(State& state, double since) const;

 private:
  std::unique_ptr<System> system_;
  StableStep stable_;
  State start_;
};

}  // namespace tissu
