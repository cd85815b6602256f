#pragma once

/// The equation that every implicit method solves, and Newton's iteration for it.

#include <memory>
#include <string_view>
#include <vector>

#include "tissu/contact/barrier.h"
#include "tissu/step/integrator.h"
#include "tissu/step/part_balance.h"
#include "tissu/step/rigid_correction.h"
#include "tissu/step/system.h"
#include "tissu/step/turn_ahead.h"

namespace tissu {

/// M (v - v^) = push f(x(v), v) at the time of `base`, x(v) = the positions of `base` moved by `move` v: one
/// implicit method is one choice of `base`, v^ (the velocities of `base`), `move` and `push` [s]. Contacts
/// are looked at where the step ends, at the time `end`.
struct Stage {
  State base;
  double move = 0.0;
  double push = 0.0;
  double end = 0.0;
  ContactStage contact = {};
  Past past = {};  ///< how `base` follows from the start of the step
};

/// What a method does to the energy of a world in which nothing adds any: in each step it falls, or it may
/// vary.
enum class EnergyLaw { falls, varies };

class StageSolver {
 public:
  /// `most_left`: of what acts on a body, what a step that is linearised once may leave. The less a method
  /// damps, the less it may be.
  StageSolver(NewtonSettings newton, PartBalance::Shares most_left, EnergyLaw energy = EnergyLaw::varies);
  void prepare(const World& world, LinearSolver* solver, Profile& profile);
  /// Follows an edit of the world in place.
  void follow_edit(std::span<const std::int32_t> rows);
  /// Before an edit: what is connected.
  void count_parts();
  /// After it: more is apart than was, or it may be.
  [[nodiscard]] bool came_apart();
  /// The stage, to be filled before `solve`.
  [[nodiscard]] Stage& stage() { return stage_; }
  [[nodiscard]] System& system() { return *system_; }
  [[nodiscard]] const World& world() const { return system_->world(); }

  /// Begins a step of h from `start`: the stage takes `start` with `time` as its base, moved and pushed by h.
  void begin(const State& start, double time, double h);
  /// Where motion is given: v is the mean velocity of the step of h from `start` to `time`, and the base
  /// stands where it leads to `share` of the way.
  void lead(const State& start, double time, double h, double share);
  /// Those velocities, put into v.
  void copy_given(Reals v) const { system_->world().fixed().copy(given_, v); }
  /// Assembles the matrix of the stage and lets the solver make what it needs of it, before there is a step.
  void prepare_ahead();
  /// Solves for v from the guess that it holds; `state` gets x(v) and v. The report is added to.
  void solve(State& state, std::vector<double>& v, StepReport& report);
  /// v += seconds M^-1 of the contact forces of the way that the latest solve found, on free rows; nothing
  /// where nothing touches.
  void add_contact_impulse(double seconds, Reals v);
  /// Contacts of a way of h change the velocities at its end, too: what was shut neither closes nor slides
  /// on. Rows whose way was cut have the velocity of their way.
  void end_touching(double h, State& end);

  /// As `Integrator` has it.
  void take_part(bool early, double share) {
    gives_up_early_ = early;
    is_part_ = share < 1.0;
    if (contact_ != nullptr) contact_->run().take_part(share);
  }

  /// push f - M (v - v^) at x(v), which goes into `state` with v; zero where motion is given. Its norm.
  double residual(State& state, ConstReals v);
  [[nodiscard]] ConstReals right() const { return right_; }
  /// What acts at the latest residual, by which it is judged [N s]: the largest of the external impulse, the
  /// change of momentum, and the reactions' impulse where nodes are led. Free rows only.
  [[nodiscard]] double acting() const { return acting_; }
  /// The external impulse of the stage is a part of what acts. `solve` does it itself.
  void judge_by_load();
  /// The step that was solved is one in which a free rigid body, a sheet or a line struck something, so that
  /// velocities of before do not go on after it.
  [[nodiscard]] bool struck() const { return contact_ != nullptr && contact_->struck(); }

 private:
  enum class Search { none, residual, energy };
  void prepare_contact();
  void solve_free(State& state, std::vector<double>& v, StepReport& report);
  void first_solve(std::vector<double>& v, StepReport& report);
  /// Where forces are linearised in the first system: the base, but for parts that turn.
  [[nodiscard]] State& linearised_at() { return turns_ ? turned_ : stage_.base; }
  /// far_turns.cpp: rotations of nodes, which are turned by vectors; those of rigid bodies stand alone.
  void list_turning();
  /// A node is turned by so much more than it would go on by itself that a linearisation says little of it.
  [[nodiscard]] bool turns_far(ConstReals v) const;
  /// push f + push move K (v + given - v*) + push D given - M (v - v^ + given) goes into right_, free rows
  /// only, with f, K and D at `linearised_at`, to which v* leads; changes of velocity that are given go into
  /// given_change_.
  void lay_right(std::vector<double>& v);

  // touching.cpp: steps of a world with contact.
  void solve_touching(State& state, std::vector<double>& v, StepReport& report);
  void begin_touching(State& state, std::vector<double>& v);
  /// Systems that differ in contacts alone: what is elastic stays linearised at the base.
  bool solve_contacts(State& state, std::vector<double>& v, StepReport& report);
  void iterate_contacts(State& state, std::vector<double>& v, StepReport& report);
  /// `judge_linearised` with the contacts that act, which have to stay.
  void judge_touching(State& state, std::vector<double>& v, StepReport& report);
  /// Contacts are looked at where v leads, and stay as they are.
  bool fits_contacts(State& state, std::vector<double>& v, StepReport& report);
  /// Where the step ends if its equation is solved by x(v), which is where `state` is: `state` itself, or
  /// another one.
  State& end_of(State& state);
  /// Velocities that lead to an end, of rows that were held back.
  void follow(const State& end, std::vector<double>& v);
  /// What rows that free rows held back lost by that goes to all of them.
  void keep_momentum(std::vector<double>& v);
  void set_contacts(State& state);

  // barrier_touching.cpp: steps in which contact has a potential.
  void solve_barrier(BarrierContact& barrier, State& state, std::vector<double>& v, StepReport& report);
  /// v leads to where ways begin: what is led is at its end, all else at the start or where it was pushed.
  /// The number of rows that had to be held back on the way there.
  int stand(State& state, std::vector<double>& v);
  /// Newton's iteration along which the energy falls; why it did not converge, or nothing.
  std::string_view descend_barrier(BarrierContact& barrier, State& state, std::vector<double>& v,
                                   StepReport& report);
  /// Goes a share of change_ that leads through nothing and lowers the energy from `from`; false: none.
  bool is_cut(State& state);
  bool search_barrier(BarrierContact& barrier, double from, State& state, std::vector<double>& v);
  /// The potential at x(v) with that of contact.
  double potential(BarrierContact& barrier, State& state, ConstReals v);

  /// Looks at contacts, keeps ways free and updates multipliers: what each takes is a row of the profile.
  double look(const State& at);
  int hold_back(State& to);
  void update_contacts(const State& end);

  // linearised.cpp: steps that are linearised once.
  /// Parts that turn are linearised where they turn to, and v is a guess that leads there.
  void turn_ahead(std::vector<double>& v);
  /// What viscosity strains by in `state` of v: a way that only turns a part is a chord, and its velocity at
  /// the end of the way would strain what turns. The velocity that the method gives to such a way is taken
  /// from v, and no rate of strain is left of it.
  void set_straining(ConstReals v, State& state) const;
  /// What became of v: nothing, it was corrected from `uncorrected_` by rigid motions, or it was iterated on.
  enum class Judged { kept, corrected, iterated };
  /// Such steps are judged: there is something that is not linear.
  [[nodiscard]] bool is_judged() const { return newton_.iterations == 1 && !world().is_linear(); }
  /// What acts on each part is counted anew from here on, and parts are found again after an edit.
  void balance_parts();
  /// Rigid motions of parts take what the latest residual, of v, holds of them; v stays if that does not
  /// help. `uncorrected_` is v before. The residual afterwards is left in `left`. True: v is another one.
  bool correct_rigidly(State& state, std::vector<double>& v, double& left);
  /// Iterates on such a step where it made things worse or left much; if that fails, the step stays as it is
  /// unless it made things worse. It is hasty then, and where it gained energy.
  Judged judge_linearised(State& state, std::vector<double>& v, StepReport& report);
  /// The latest residual, of `state`, is more than some times what acts on some body. A turn of a stiff body
  /// leaves strains, and so does the guess of the next step, which is then no worse. Damping counts with the
  /// stiffness where the step was linearised: either is of first order, and at the end the stiffness of a
  /// membrane may be one that gives energy.
  bool leaves_much(const State& state);
  /// What supports that are led give in the step, as far as they strain a part: a drift of all of them acts
  /// on nothing.
  void look_at_reactions();
  static constexpr int kRescue = 10;  ///< of Newton's iterations at most
  /// Newton's iteration ended where it is good enough for such a step; `why`: as `iterate` says it.
  [[nodiscard]] static bool is_near(std::string_view why, const StepReport& report);
  /// Newton's iteration from v = `once_` and, failing that, from the guess. False: it did not come near.
  bool rescue(State& state, std::vector<double>& v, StepReport& report);
  /// From the start of the step to `state`, in a world in which nothing can add any.
  bool gains_energy(const State& state);

  /// The solution is one that lies below the guess: far above it there may be others, which no body reaches.
  bool is_lower(State& state, ConstReals v);
  /// Newton's iteration from v; why it did not converge, or nothing. Whole steps may pass through worse
  /// states on the way to a better one; else they are halved until the residual falls, or until the energy
  /// does.
  std::string_view iterate(State& state, std::vector<double>& v, Search search, int most, StepReport& report);
  /// trial = v and that share of the change.
  void go(ConstReals v, double share);
  bool advance(State& state, std::vector<double>& v, Search search, double& now);
  bool descend(State& state, std::vector<double>& v, double& now);
  /// What damping takes on a share s of change_, s (linear + s square), which has no potential: with df/dv as
  /// it is at `state` and its v, 1/2 push v . D v. Zero for damping that gives, as Rayleigh's does where the
  /// stiffness is not positive. It writes to work_.
  struct DampingWork {
    double linear = 0.0;
    double square = 0.0;
    [[nodiscard]] double at(double share) const { return share * (linear + share * square); }
  };
  DampingWork damping_work(const State& state);
  /// The matrix of the equation: mass M - push D - push move K.
  void assemble(const State& state, bool definite, double mass = 1.0);
  /// Solves A change_ = right_ with that matrix at `state`; it is made definite where it is not.
  SolveReport solve_linear(const State& state, double floor, bool definite, StepReport& report);
  /// `state` = x(v) and v.
  void place(State& state, ConstReals v) const;
  /// Half |v - v^|^2 in M, and push / move of what the forces store: its slope is minus the residual.
  double potential(State& state, ConstReals v);

  NewtonSettings newton_;
  std::unique_ptr<System> system_;
  Stage stage_;
  std::vector<double> given_;         ///< mean velocities where motion is given
  std::vector<double> given_change_;  ///< from the guess to them; zero on free rows
  std::vector<double> guess_;
  std::vector<double> first_;  ///< v before Newton's iteration
  std::vector<double> once_;   ///< v of a step that was linearised once
  std::vector<double> uncorrected_;
  std::vector<double> trial_;
  std::vector<double> change_;
  std::vector<double> right_;
  std::vector<double> work_;
  std::vector<double> momentum_;
  std::unique_ptr<ImplicitContact> contact_;  ///< null where nothing touches
  std::unique_ptr<EndImpulses> impulses_;
  State end_;                   ///< of a step that goes on after its equation
  State way_end_;               ///< of a way that is tested
  std::vector<double> placed_;  ///< at an end, before ways were cut
  std::vector<Quaternion> placed_rotations_;
  std::vector<std::int32_t> cut_;        ///< rows that were held back in the latest solve
  std::vector<std::size_t> cut_frames_;  ///< frames whose rotations were
  std::vector<double> before_cut_;       ///< velocities without that
  Profile* profile_ = nullptr;
  std::size_t detection_row_ = 0;  ///< of the profile; there where something touches
  std::size_t travel_row_ = 0;
  std::size_t response_row_ = 0;
  const State* step_start_ = nullptr;  ///< of the step
  std::vector<std::int32_t> turning_;  ///< rows of rotations of nodes
  std::vector<double> blocks_;         ///< diagonal of the matrix without contact
  std::vector<double> elastic_;        ///< what is right without contact
  Scratch scratch_;                    ///< of energies
  bool gives_up_early_ = false;
  bool is_part_ = false;  ///< of a step that contact divided
  PartBalance balance_;
  RigidCorrection rigid_;
  TurnAhead ahead_;
  State turned_;                 ///< the base, with parts that turn where they turn to
  std::vector<double> turn_to_;  ///< the velocities that lead there from the base
  std::vector<double>
      turning_by_;  ///< those of parts that turn as rigid bodies; empty where nothing is viscous
  bool turns_ = false;
  bool is_viscous_ = false;     ///< something strains by velocities
  std::size_t part_count_ = 0;  ///< before an edit
  bool knows_parts_ = false;    ///< balance_, rigid_ and ahead_ are those of the world as it is
  PartBalance::Shares most_left_;
  EnergyLaw energy_;
  double reference_ = 0.0;  ///< push |external force|
  double acting_ = 0.0;
  double start_ = 0.0;       ///< residual that the first solve found
  bool is_falling_ = false;  ///< the last of Newton's iterations at least halved the least residual
};

}  // namespace tissu
