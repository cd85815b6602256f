#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/base/profile.h"
#include "tissu/solve/linear_solver.h"
#include "tissu/state/row_blend.h"
#include "tissu/world/world.h"

namespace tissu {

struct StepReport {
  double time = 0.0;  ///< at the end of the step [s]
  int newton_iterations = 0;
  int solver_iterations = 0;
  double residual = 0.0;   ///< of the last linear system, or of Newton's equation over what acts when it
                           ///< is iterated
  int indefinite = 0;      ///< systems whose matrix was not positive definite, and was made so
  bool converged = false;  ///< every tolerance was met
  int contacts = 0;        ///< that press at the end of the step
  int held_back = 0;       ///< rows whose way was cut so that nothing passes through anything
  double least_gap = std::numeric_limits<double>::infinity();  ///< distance of the nearest of them, as a
                                                               ///< share of that at which surfaces rest
  bool hasty = false;  ///< what was linearised once left more residual than it found, and no
                       ///< iteration mended it
  double depth =
      0.0;  ///< of the deepest contact at the end, as a share of its gap, where parts open by shares
  bool turned_far = false;    ///< a node turned by more than a linearised step bears
  int substeps = 1;           ///< parts in which the step was taken: more than one only where something
                              ///< touches, or nodes have rotations
  double milliseconds = 0.0;  ///< wall time of the step
  std::string message;        ///< empty, or why it did not converge, or what to know of where it converged
};

/// What to do where the matrix of a step is not positive definite, as it may be under compression.
enum class Indefinite {
  project,  ///< each cell's share is replaced by the nearest positive semi-definite one, in such steps only
  regularise,  ///< a growing share of the diagonal is added until it is
  refuse       ///< the step is not taken
};

/// Newton's iteration inside a step.
struct NewtonSettings {
  int iterations = 1;  ///< 1: the equations are linearised once, and iterated only where that made them worse
  double tolerance =
      1e-6;  ///< on the norm of the residual, relative to what acts: loads, reactions, changes of momentum
  Indefinite indefinite = Indefinite::project;
};

class Integrator {
 public:
  Integrator() = default;
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Its steps end in equilibrium, and time only distinguishes loads.
  [[nodiscard]] virtual bool is_static() const { return false; }
  /// It damps no motion by itself, so that energy it adds stays in the bodies, and solves systems.
  [[nodiscard]] virtual bool is_undamped() const { return false; }
  /// Allocates what its steps need. Called before the first step, and again after an edit. `solver` outlives
  /// the steps; null for methods that solve no system.
  virtual void prepare(const World& world, LinearSolver* solver, Profile& profile) = 0;
  /// Makes what a first step of h from this state will ask for, so that it takes no longer than others. It
  /// changes nothing of what steps give.
  virtual void prepare_ahead(const State& /*state*/, double /*h*/) {}
  /// The largest step that is stable at a state [s]; infinite for methods that have no such limit.
  [[nodiscard]] virtual double stable_step(const State& /*state*/) {
    return std::numeric_limits<double>::infinity();
  }
  /// The world is stiffer or softer than the one before, or may be: a limit that was found there is none
  /// here.
  virtual void forget_stable_step() {}
  /// The next step is that share of one that was asked for. `early`: if its contacts do not settle, it may
  /// say so before all its systems, because shorter ones will be taken instead.
  virtual void take_part(bool /*early*/, double /*share*/) {}
  /// Moves the state by h [s]. The state is undefined when it throws.
  virtual StepReport step(State& state, double h) = 0;
  /// What the next step needs beside the state, such as earlier states, goes to the end of `memory`: nothing
  /// for methods of one step.
  virtual void append_memory(std::vector<double>& /*memory*/) const {}
  [[nodiscard]] std::vector<double> memory() const {
    std::vector<double> memory;
    append_memory(memory);
    return memory;
  }
  /// Goes on from what was appended; an empty one starts anew.
  virtual void restore(ConstReals /*memory*/) {}
  /// Follows an edit of its world in place, after which some rows of the pattern have other columns. False:
  /// it is to be prepared again.
  virtual bool follow_edit(std::span<const std::int32_t> /*rows*/) { return false; }
  /// Around an edit. What a method keeps of forces before it does not act on what they no longer hold.
  virtual void before_edit() {}
  virtual void after_edit() {}
  /// Rows that an edit made take over what is kept of others.
  virtual void copy_rows(std::span<const RowCopy> /*copies*/) {}
  /// The same for rows between others.
  virtual void blend_rows(std::span<const RowBlend> /*blends*/) {}
};

}  // namespace tissu
