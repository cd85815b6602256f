#pragma once

/// The one virtual boundary of the forces: tens of calls a step, never one for each element.
///
/// A model is constant while a world runs. What it works with is the caller's (Scratch), what it remembers is
/// the state's (State::memory).

#include <string_view>

#include "tissu/assembly/block_matrix.h"
#include "tissu/assembly/couplings.h"
#include "tissu/force/scratch.h"
#include "tissu/state/state.h"

namespace tissu {

/// What to add of a model's derivatives: position * df/dx + velocity * df/dv.
struct StiffnessScale {
  double position = 0.0;
  double velocity = 0.0;
  /// Of the matrix only, not of the product: each cell's share of -df/dx is replaced by the nearest positive
  /// semi-definite one, that of continuum elements point by point. df/dv is so as it is.
  bool definite = false;
};

enum class ForceKind { elastic, external };

/// Which verbs of a running world a model has. A step asks only those models that say so.
struct RunTime {
  bool begins = false;     ///< begin_step
  bool couples = false;    ///< add_couplings, in place of add_stiffness
  bool remembers = false;  ///< remember
};

class ForceModel {
 public:
  ForceModel() = default;
  virtual ~ForceModel() = default;
  ForceModel(const ForceModel&) = delete;
  ForceModel& operator=(const ForceModel&) = delete;

  /// The effect that it is, as profiles and plans name it.
  [[nodiscard]] virtual std::string_view effect() const = 0;
  /// Elastic forces and energies come from the body, external ones from its surroundings.
  [[nodiscard]] virtual ForceKind kind() const = 0;
  /// Its df/dx and df/dv are the same for every state.
  [[nodiscard]] virtual bool has_constant_stiffness() const { return false; }
  /// It has a stiffness at all.
  [[nodiscard]] virtual bool has_stiffness() const { return true; }
  /// What it gives to the bodies has no potential that stays the same, so that it may add energy to them.
  [[nodiscard]] virtual bool may_add_energy() const { return false; }
  /// Its damping may give energy to a body that turns, although it is there to take some: the way of a step
  /// is a chord, along which a turn at its end looks like growth, so that damping squeezes the body.
  [[nodiscard]] virtual bool may_drive_turns() const { return false; }

  /// Names the nodes it couples, once for each topology, …
  virtual void couple(SparsityBuilder& /*builder*/) const {}
  /// … and is told the pattern that came out of it.
  virtual void bind(const Sparsity& /*pattern*/) {}

  /// Numbers that its forces, products and matrices need of a Scratch. Energies may take more when they are
  /// first asked for.
  [[nodiscard]] virtual std::size_t scratch_size() const { return 0; }
  /// f += force [N] (moments [N m] in rotation blocks)
  virtual void add_force(const State& state, Scratch& scratch, Reals f) const = 0;
  /// matrix += scale.position df/dx + scale.velocity df/dv
  virtual void add_stiffness(const State& /*state*/, Scratch& /*scratch*/, StiffnessScale /*scale*/,
                             BlockMatrix& /*matrix*/) const {}
  /// out += (scale.position df/dx + scale.velocity df/dv) p
  virtual void add_product(const State& /*state*/, Scratch& /*scratch*/, StiffnessScale /*scale*/,
                           ConstReals /*p*/, Reals /*out*/) const {}
  /// Stored energy [J]; of a force with a potential the one whose negative gradient is `add_force`, at every
  /// load factor.
  [[nodiscard]] virtual double energy(const State& /*state*/, Scratch& /*scratch*/) const { return 0.0; }
  /// The share of the energy of something elastic that is the potential of outer forces, which it bears [J].
  [[nodiscard]] virtual double potential(const State& /*state*/) const { return 0.0; }

  // What changes while a world runs.
  [[nodiscard]] virtual RunTime run_time() const { return {}; }
  /// Claims places in the memory of states, once for each world.
  virtual void claim_memory(MemoryPlaces& /*places*/) {}
  /// Once a step of h [s], before anything reads the state; it may write into its own memory.
  virtual void begin_step(State& /*state*/, Scratch& /*scratch*/, double /*h*/) const {}
  /// Adds its matrix, scale.position df/dx + scale.velocity df/dv, as couplings between the rows that it
  /// couples now: their H is positive semi-definite.
  virtual void add_couplings(const State& /*state*/, StiffnessScale /*scale*/,
                             Couplings& /*couplings*/) const {}
  /// Writes into its memory what the step that led to `state` adds; memory_time is left to the caller.
  virtual void remember(State& /*state*/) const {}
  /// Takes over what `before`, any model of the world before an edit, kept in `then`; `now` holds the memory
  /// of a state at rest.
  virtual void carry_memory(const ForceModel& /*before*/, const Memory& /*then*/, Memory& /*now*/) const {}
  /// Refuses a memory from outside that it could not read.
  virtual void check_memory(const State& /*state*/) const {}
};

}  // namespace tissu
