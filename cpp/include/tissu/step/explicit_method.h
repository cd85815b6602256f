#pragma once

#include <memory>
#include <vector>

#include "tissu/contact/explicit_contact.h"
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
  void take_part(bool /*early*/, double share) override { is_part_ = share < 1.0; }
  void append_memory(std::vector<double>& memory) const override { stable_.append_memory(memory); }
  void restore(ConstReals memory) override { stable_.restore(memory); }
  void after_edit() override { stable_.forget(); }
  void forget_stable_step() override { stable_.forget(); }

 protected:
  /// What one step does to vibrations.
  [[nodiscard]] virtual Amplification amplification() const = 0;
  /// Its steps look at states beyond their start, where impulses have not acted.
  [[nodiscard]] virtual bool has_stages() const { return false; }
  /// The way of a step has the angular velocities of angular momenta that stay on it (`move_freely`); else
  /// frames go by the vectors that turn them.
  [[nodiscard]] virtual bool turns_freely() const { return true; }
  /// Moves `state`, which is start(), by h.
  virtual void advance(State& state, double h) = 0;

  [[nodiscard]] const State& start() const { return start_; }
  [[nodiscard]] const World& world() const { return system_->world(); }
  /// a = M^-1 f at a state, which counts in the step by that share; frames with their inertia at the start.
  void acceleration(const State& state, double share, Reals a);
  /// The places at the end of a step from the mean velocities `way`; `state` has its velocities. `pushed`:
  /// the share that the way has of the change of velocity by a force that stays.
  void go(ConstReals way, double pushed, double h, State& state);
  /// Puts led nodes where they are at the time of `state`, `since` after the start, with the velocity that
  /// leads there.
  void lead(State& state, double since) const;

 private:
  /// Whether the energy of the bodies is a number. Forces at the end of a step are those of the next one, so
  /// nothing else would tell.
  [[nodiscard]] bool has_energy(const State& state);
  // Of worlds with contact: explicit_touching.cpp.
  void prepare_touching(const World& world, Profile& profile);
  void begin_touching(double h);
  void push(const State& state, double share, Reals f);
  /// Places and velocities at the end, with nothing passed through.
  void touch(ConstReals way, double pushed, double h, State& state);
  void look(const State& at, const State* goal);
  void strike(double pushed, double h, State& state);
  void place(ConstReals way, double h, State& state);
  int hold_back(double h, State& state);
  void require_bearable(double h, double limit) const;
  void tell_depth(StepReport& report) const;

  std::unique_ptr<System> system_;
  StableStep stable_;
  State start_;
  Scratch scratch_;
  std::unique_ptr<ExplicitContact> contact_;  ///< null where nothing touches
  Profile* profile_ = nullptr;
  std::size_t detection_row_ = 0;  ///< of the profile; there where something touches
  std::size_t travel_row_ = 0;
  std::size_t response_row_ = 0;
  State led_;                      ///< where given rows are at the end of the step
  std::vector<double> free_way_;   ///< mean velocities without impulses, …
  std::vector<double> free_ends_;  ///< … velocities at the end without them, …
  std::vector<double> change_;     ///< … and what these change
  std::vector<double> way_;
  std::vector<double> placed_;  ///< before ways were cut, …
  std::vector<Quaternion> placed_rotations_;
  std::vector<double> unlifted_;  ///< … and before what was too deep was lifted; there if lifted_
  std::vector<Quaternion> unlifted_rotations_;
  bool lifted_ = false;
  int held_back_ = 0;
  bool looked_ = false;   ///< in this step
  bool is_part_ = false;  ///< of a step that was divided
};

}  // namespace tissu
