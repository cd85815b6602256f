#pragma once

/// Contact during the steps of an explicit method. What is led goes first and pushes, a response gives forces
/// or changes velocities, and ways are shortened until nothing passes through anything.

#include <limits>
#include <memory>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/assembly/mass.h"
#include "tissu/contact/contact_mass.h"
#include "tissu/contact/contact_run.h"

namespace tissu {

/// What contact adds to the fastest vibration of a body: omega^2 grows by that of `frequency`, df/dv by the
/// damping [1/s].
struct ContactRates {
  double frequency = 0.0;
  double damping = 0.0;
};

class ExplicitContact {
 public:
  /// A contact that is deeper inside its gap, as a share of that, is not solved: springs end in its last
  /// fifth.
  static constexpr double kTooDeep = 0.9;

  /// `frequency`: the largest one of the bodies at rest [1/s].
  static std::unique_ptr<ExplicitContact> make(const Contact& contact, const FixedDofs& fixed,
                                               const Mass& mass, double frequency);
  ExplicitContact(const Contact& contact, const FixedDofs& fixed, const Mass& mass);
  virtual ~ExplicitContact() = default;
  ExplicitContact(const ExplicitContact&) = delete;
  ExplicitContact& operator=(const ExplicitContact&) = delete;

  /// What its forces may add at most; nothing where it has none.
  [[nodiscard]] virtual ContactRates rates() const { return {}; }
  /// The frequency that the step's contacts have added, which may be more [1/s].
  [[nodiscard]] virtual double stiffest() const { return 0.0; }
  /// A step begins at `start`, which outlives it, and ends at the time `end`; `led` has given rows and
  /// rotations where they are then.
  void begin(const State& start, double end, const State& led);
  /// Looks at the places of `at`, on ways to `goal`; null: ways were cut, and led to where they were cut
  /// from.
  void look(const State& at, const State* goal) { run_.detect(at, goal); }
  /// Its forces stay during a step those of the look at its start.
  [[nodiscard]] virtual bool stays() const = 0;
  /// f += the forces of the latest look, which count in the step's mean force by that share.
  virtual void add_force(const State& at, double share, Reals f) = 0;

  // Impulses of the contacts of the latest look.
  /// They are needed before any way is cut.
  [[nodiscard]] virtual bool strikes_first() const = 0;
  /// `pushed`: the share that the way has of the change of velocity by a force that stays.
  virtual void find_blows(double pushed) = 0;
  /// Takes forces that stay out of the velocities of the way and of the end: impulses give them from now on.
  virtual void take_back(double pushed, Reals way, Reals end) = 0;
  /// What they change of the mean velocities of the way, …
  virtual void strike_way(ConstReals way, Reals change) = 0;
  /// … takes depth out of the places at the end, …
  virtual void lift(State& end) = 0;
  /// … and what they change of the velocities at the end.
  virtual void strike_end(ConstReals velocities, const State& end, Reals change) = 0;
  /// Shortens the ways to `to` until nothing passes. The number of rows that were held back.
  int hold_back(State& to) { return run_.hold_back(to); }
  /// Velocities of rows that were held back, as `ContactRun` has it.
  void keep_momentum(const Mass& mass, const FixedDofs& fixed, ConstReals before, Reals v) {
    run_.keep_momentum(mass, fixed, before, v);
  }
  /// Whether something is too deep inside what was too far away to be looked at: it looks at that end where
  /// impulses may have pressed something rigid there, which is free, and where something went far beside
  /// things with a thickness, whose middles do not stop each other.
  bool is_pressed_in(const State& end);
  /// How far contacts are inside their gaps at the end of the step, as a share, the most of them; 0 where
  /// nothing is thick, and nothing rigid is free.
  [[nodiscard]] double depth() const { return depth_; }
  /// The step is over: its contacts go into the memory of its end.
  void finish(State& end);

  [[nodiscard]] std::size_t size() const { return kept_.size(); }
  /// The least distance, as a share of xi, of a pair that acts; infinite for none.
  [[nodiscard]] double least_gap() const { return least_gap_; }

 protected:
  virtual void begin_response() = 0;
  /// Puts what acted into `kept`, with the forces `push` and what the next step takes over.
  virtual void keep(const State& end, std::vector<ContactNumbers>& kept) = 0;

  [[nodiscard]] const ContactPair& pair_of(const ContactNumbers& contact) const {
    return contact_.description().pairs[static_cast<std::size_t>(contact.pair)];
  }
  [[nodiscard]] const State& start() const { return *start_; }
  /// Contacts were looked for where something went far: what one look sees, the next may not.
  [[nodiscard]] bool goes_far() const { return goes_far_; }

  const Contact& contact_;
  ContactMass mass_;
  ContactRun run_;
  double h_ = 0.0;

 private:
  double look_at_depth(const State& at);

  const State* start_ = nullptr;
  double far_ = std::numeric_limits<double>::infinity();  ///< for two ways [m]; where nothing is thick, any
  bool goes_far_ = false;                                 ///< in this step
  std::vector<ContactNumbers> kept_;
  double least_gap_ = 0.0;
  double depth_ = 0.0;
};

/// The part of a force along a surface, no longer than Coulomb's bound.
Vec3 on_disk(const Vec3& along, double bound);

}  // namespace tissu
