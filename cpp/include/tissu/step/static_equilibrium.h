#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tissu/step/arc_length.h"
#include "tissu/step/equilibrium.h"
#include "tissu/step/integrator.h"
#include "tissu/step/static_barrier.h"
#include "tissu/step/static_contact.h"

namespace tissu {

/// Equilibrium without inertia: f(x) = 0 by continuation along a LoadPath. Every step goes in at least
/// `load_steps` parts, none of which leads a node round by more than 30 degrees. A part is solved by Newton's
/// method with whole steps, then with steps along which the energy falls. One that fails is halved, and parts
/// grow again after an easy one. Where the smallest part fails the load may turn: from there the path is
/// followed by its arc length. The sum of all Newton iterations of a step is bounded.
///
/// Where the searches of augmented contacts do not end, the barrier goes on from the last part of the load.
///
/// With contact a step without equilibrium throws Diverged: what is led would stand where bodies are.
class StaticEquilibrium final : public Integrator {
 public:
  struct Settings {
    NewtonSettings newton{50, 1e-9};
    int load_steps = 1;
    int total_iterations = 0;  ///< of a step, at most; 0: newton.iterations (load_steps + 19), four
                               ///< times that with contact
    bool arc_length = false;   ///< the whole path is followed by its arc length, not by parts of the load
  };
  explicit StaticEquilibrium(Settings settings);
  [[nodiscard]] std::string_view name() const override { return "static equilibrium"; }
  [[nodiscard]] bool is_static() const override { return true; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  StepReport step(State& state, double h) override;
  /// One number: whether the external loads act in full already.
  void append_memory(std::vector<double>& memory) const override { memory.push_back(loaded_ ? 1.0 : 0.0); }
  void restore(ConstReals memory) override { loaded_ = !memory.empty() && memory[0] != 0.0; }

 private:
  /// Goes on from a share of the load to 1 in parts; the share that was reached.
  double go_by_parts(const LoadPath& path, double share, State& state, StepReport& report);
  [[nodiscard]] bool may_go_on_by_barrier() const;
  /// Where it does not reach the end, augmented contacts go on from there in ever smaller parts.
  double go_on_by_barrier(const LoadPath& path, double share, State& state, StepReport& report);
  double go_by_arc(const LoadPath& path, double share, double part, State& state, StepReport& report);
  /// One part; true when it converged. Otherwise `state` is as it was.
  bool take(const LoadPath& path, double from, double to, State& state, StepReport& report);
  [[noreturn]] void refuse(double share, double h) const;
  [[nodiscard]] int left(const StepReport& report) const;
  /// What gave up: the load, Newton's method or the linear solver.
  [[nodiscard]] std::string reason() const;

  Settings settings_;
  bool is_bounded_ = false;  ///< total_iterations was given
  bool loaded_ = false;
  std::unique_ptr<Equilibrium> equilibrium_;
  std::unique_ptr<ArcLength> arc_;
  std::unique_ptr<StaticContact> touching_;  ///< null where nothing touches
  std::unique_ptr<StaticBarrier> barrier_;   ///< made where it goes on for augmented contacts
  StaticContact* by_ = nullptr;              ///< the one of both that searches
  bool tries_barrier_ = false;               ///< in this step, if the searches do not end
  bool rests_at_gap_ = true;                 ///< what the barrier held was brought to its gap
  std::string why_not_by_barrier_;           ///< of this step
  int set_aside_ = 0;                        ///< iterations of the step that do not count
  Profile* profile_ = nullptr;
  State start_;                  ///< of the step
  State before_;                 ///< of the part of the load
  bool solver_gave_up_ = false;  ///< since the last part that converged
  ArcLength::End arc_ended_ = ArcLength::End::unused;
};

}  // namespace tissu
