#pragma once

/// A world, its state, and the loop that moves it.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/base/profile.h"
#include "tissu/edit/cut_body.h"
#include "tissu/edit/repair_body.h"
#include "tissu/edit/world_editor.h"
#include "tissu/simulation/energy_watch.h"
#include "tissu/simulation/inverted_cells.h"
#include "tissu/simulation/snapshot.h"
#include "tissu/solve/linear_solver.h"
#include "tissu/step/integrator.h"
#include "tissu/world/run_time.h"
#include "tissu/world/world.h"

namespace tissu {

class Simulation {
 public:
  /// `solver` may be null for methods that solve no system.
  Simulation(std::shared_ptr<const World> world, std::unique_ptr<Integrator> integrator,
             std::unique_ptr<LinearSolver> solver);

  /// One step of h [s]. Throws Diverged, with the state as it was before, when a value is not finite, a
  /// node would fly further than a thousand times the size of the scene, or an undamped method has multiplied
  /// the energy (EnergyWatch).
  StepReport step(double h);

  /// Makes what the first step will ask for if it is one of h [s]: orderings, aggregates, a preconditioner.
  /// Steps give the same bits without. Only before the first step.
  void prepare_ahead(double h);

  /// The largest step that is stable now [s]; infinite for methods that have no such limit.
  [[nodiscard]] double stable_step();

  [[nodiscard]] const World& world() const { return *world_; }
  /// The same, for what goes on using it when an edit has made another one.
  [[nodiscard]] const std::shared_ptr<const World>& shared_world() const { return world_; }
  /// How often the world was edited or replaced: what is kept of one holds until this changes.
  [[nodiscard]] std::uint64_t edits() const { return edits_; }
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] State& state() { return state_; }
  /// What the state remembers under a name, to be changed between two steps; refuses unknown names.
  [[nodiscard]] std::vector<double>& memory(std::string_view name) {
    return memory_of(*world_, state_, name);
  }
  [[nodiscard]] Energy energy() const;
  [[nodiscard]] Profile& profile() { return profile_; }
  [[nodiscard]] const Integrator& integrator() const { return *integrator_; }
  /// Null when no system is solved.
  [[nodiscard]] const LinearSolver* solver() const { return solver_.get(); }

  /// What supports and led nodes give to the bodies [N], three for each node, zero where nothing is held:
  /// M dv/dt - f with the change of velocity of the latest step.
  [[nodiscard]] std::vector<double> reactions() const;
  /// The world was replaced by one in which less is connected: what the method keeps of earlier forces acts
  /// no longer.
  void forget_forces() { integrator_->after_edit(); }
  /// The world was replaced by one with other numbers: the largest stable step is found anew.
  void forget_stable_step() { integrator_->forget_stable_step(); }
  /// Held rows begin with the velocities that the state has now, as a motion that drifts with its body.
  void keep_held_velocities() { world_->fixed().copy(state_.velocities, held_); }
  /// Puts nodes that are not unknowns where they are now, before positions or velocities are read.
  void settle();

  /// What a simulation of the same scene needs to go on from here, with the same bits. The solver forgets
  /// what it keeps of earlier steps, since a run that goes on from the snapshot does not have it.
  Snapshot snapshot();
  /// Goes on from a snapshot of a simulation of the same scene; this one has all its cells still. Refuses
  /// what does not fit the world.
  void restore(const Snapshot& snapshot);

  /// From now on edits are made in place where they can: the simulation goes on with a world of its own.
  void prepare_edits();
  /// An edit that was made.
  struct Edited {
    CutPlan plan;
    bool relaid = false;  ///< everything was laid anew, in place of what was touched only
    BodyTotals before;    ///< of the body, or of what was touched of it
    BodyTotals after;
    /// At rest, of the cells that a cut divided or whose nodes it moved; see `least_quality` of cut_body.h.
    double least_quality = std::numeric_limits<double>::infinity();
  };
  /// Cuts a body, or takes cells out of it, between two steps. Nothing has changed where they throw.
  Edited cut(std::string_view body, const Sweep& sweep, const CutOptions& options);
  /// Repairs cells that cuts left (repair.h); `before` and `after` are totals of the body.
  struct Repaired : Edited {
    RepairCounts counts;
  };
  Repaired repair(std::string_view body, const RepairOptions& options);
  Edited ablate(std::string_view body, std::vector<std::int32_t> cells);
  void remove_cells(std::string_view body, std::span<const std::int32_t> cells);
  /// The connected parts of the material of a body of a world that can be edited.
  [[nodiscard]] std::vector<Piece> pieces(std::string_view body) const;

  /// Of all contacts on a body or an obstacle in the latest step. A cut after it may drop contacts, but not
  /// the force that they had. The world has contacts.
  [[nodiscard]] Contact::Wrench contact_force_on(std::int32_t surface) const;

  /// Goes on with another world of the same unknowns: made by an editor from this one, or of the same scene
  /// with other numbers in it. What models remember goes along, as far as the new ones have it too; rows of
  /// nodes that an edit made take over everything of those that they copy.
  void replace_world(std::shared_ptr<const World> world, std::span<const RowCopy> copies = {},
                     std::span<const RowBlend> blends = {});

  /// What `rewind` goes back to: the world and all that its next step depends on.
  struct Mark {
    std::shared_ptr<const World> world;                 ///< null: of this description, from which it is laid
    std::shared_ptr<const WorldDescription> described;  ///< of a world that edits changed in place
    State state;
    State last_good;
    std::vector<double> held;
    std::vector<double> integrator;
    std::vector<double> watch;
    bool settled = true;
  };
  /// The solver forgets what it keeps of earlier steps, as a snapshot says.
  [[nodiscard]] Mark mark();
  /// Goes back to a mark of this simulation, with the same bits from there on.
  void rewind(const Mark& mark);
  /// The solver forgets what it keeps of earlier steps, as when a simulation begins or a snapshot is taken.
  void forget_solves();

 private:
  bool gains_energy(const State& start, int halvings);
  /// A step of a world with contact: in halves of halves where surfaces would have to be held back.
  StepReport step_in_parts(double h, int halvings);
  Edited make(std::string_view body, CutPlan plan);
  void go_on_with(CutWorld made, std::string_view body, Edited& edited);
  /// Before a cut.
  void keep_contact_forces();
  void follow(const WorldEditor::Made& made);
  void take_over(std::span<const RowCopy> copies, std::span<const RowBlend> blends = {});
  /// Whether the world is still the one of a mark.
  [[nodiscard]] bool is_at(const Mark& mark) const;
  void return_to_world(const Mark& mark);
  [[nodiscard]] double farthest() const;
  [[nodiscard]] bool is_sane() const;
  [[noreturn]] void roll_back(double h);
  [[nodiscard]] bool is_led_live() const;
  /// Of the world as it is: one that may be grabbed, say, is not watched.
  void renew_watch();
  void watch_energy(EnergyWatch& watch, StepReport& report);
  /// Adds to the report of a static step which cells are inside out.
  void tell_inverted(InversionCheck& check, StepReport& report);
  /// Where a part of a step began.
  struct PartStart {
    State state;
    std::vector<double> integrator;
  };
  /// Velocities of held rows are the scene's, whatever was written there.
  void hold() { world_->fixed().copy(held_, state_.velocities); }
  void keep_velocities();

  std::shared_ptr<const World> world_;
  std::unique_ptr<WorldEditor> editor_;                ///< of the world; null: edits lay everything anew
  std::shared_ptr<const World> kept_;                  ///< the same as the world, until an edit in place
  std::shared_ptr<const WorldDescription> described_;  ///< of the world, for marks, until an edit in place
  std::uint64_t edits_ = 0;
  bool edits_in_place_ = false;
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<LinearSolver> solver_;
  Profile profile_;
  State state_;
  State last_good_;
  Scratch scratch_;
  std::vector<double> held_;  ///< velocities of held rows, as the scene and the latest step left them
  std::vector<Contact::Wrench> contact_forces_;  ///< of each surface in the latest step, if a cut followed it
  std::vector<PartStart> part_starts_;           ///< of each halving that there was, where something touches
  bool settled_ = true;
  std::optional<EnergyWatch>
      watch_;  ///< of undamped methods and where surfaces meet, if nothing can add energy
  std::optional<InversionCheck> inverted_;  ///< of static methods
};

}  // namespace tissu
