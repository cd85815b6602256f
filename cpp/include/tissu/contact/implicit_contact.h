#pragma once

/// Contact during the steps of implicit and static methods: a response that is linear in the positions while
/// a system is solved, f = push - H (r - place), and is looked at again after it.
///
/// k = s a / (move push), 1/a = |sum_r N_r beta_r^2 A_rr^-1| with the blocks A_rr of the step's own matrix
/// and the contacts N_r at a row, s = 3: the couplings never exceed three times the block diagonal of A,
/// whatever the scene.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tissu/assembly/mass.h"
#include "tissu/contact/body_forces.h"
#include "tissu/contact/contact_run.h"
#include "tissu/contact/end_impulses.h"

namespace tissu {

/// How the positions and the impulse of a step follow from those of its equation: its end lies `stretch`
/// times as far from the start as where forces are taken, and contact counts `times` as often there, so that
/// its impulse moves the end as in implicit Euler.
struct ContactStage {
  double stretch = 1.0;
  double times = 1.0;
};

class BarrierContact;

class ImplicitContact {
 public:
  /// `mass`: null in static steps; `rest`: diagonal blocks of the stiffness at rest, [row][9], where
  /// `needs_rest`; `extent` of the scene [m]; `method`: that of the contact, or another one.
  static std::unique_ptr<ImplicitContact> make(const Contact& contact, const FixedDofs& fixed,
                                               const Mass* mass, std::vector<double> rest, double extent,
                                               ContactMethod method);
  [[nodiscard]] static bool needs_rest(ContactMethod method) { return method == ContactMethod::penalty; }
  ImplicitContact(const Contact& contact, const FixedDofs& fixed);
  virtual ~ImplicitContact() = default;
  ImplicitContact(const ImplicitContact&) = delete;
  ImplicitContact& operator=(const ImplicitContact&) = delete;

  /// This, if its forces have a potential along which steps descend; else null.
  [[nodiscard]] virtual BarrierContact* barrier() { return nullptr; }
  [[nodiscard]] ContactRun& run() { return run_; }
  [[nodiscard]] const ContactRun& run() const { return run_; }

  /// A step begins at `start`, which outlives it, and ends at the time `end`; `led` has given rows and
  /// rotations where they are then. Forces on a body are judged by a thousandth of its `load` [N]; it may be
  /// empty.
  void begin(const State& start, double end, const State& led, ConstReals load);
  /// The diagonal blocks of the step's matrix without contact, [row][9], which outlive the step, and the
  /// scale of what is added to it: move times push.
  virtual void set_matrix(std::span<const double> blocks, double scale, const ContactStage& stage);
  /// How many times stiffer than that multipliers are against coming nearer, and against sliding: 1, as at
  /// first.
  void set_stiffer(double normal, double tangent);
  /// Against coming nearer, the same of contacts of rigid bodies, sheets and lines, until the step is over:
  /// where a heavy body presses on a light one, the light one says how stiff they are, and the multipliers
  /// reach the heavy one's slowly.
  void set_stiffer_whole(double times) { whole_ = times; }
  /// Contacts at the places of `at`, with the multipliers of those that were there before. By how much their
  /// forces differ from those of the latest solve, as a share.
  double look(const State& at);
  /// How far contacts that act are deeper than multipliers let them, or press where they are open, as a share
  /// of the gap, at the latest look.
  [[nodiscard]] double depth() const { return depth_; }
  /// A system was solved with the contacts of the latest look, and led to `end`: multipliers become the
  /// forces there.
  void update(const State& end);
  /// The part of the forces with which that system was solved that no contact can give, since it pulls or
  /// lies beyond Coulomb's disk: on the body where it is the largest share of the rest of them.
  [[nodiscard]] double inadmissible() const { return inadmissible_; }
  /// The contacts of the latest look are those that act from now on.
  virtual void take() { run_.acting().swap(pressing_); }
  /// A look finds what presses wherever it is, and it may pull in the next system.
  [[nodiscard]] virtual bool holds_on() const { return false; }
  /// The contacts that act, into the memory of a state at which the forces of the step are taken.
  void write(State& state) const;
  /// The step is over: contacts keep the forces with which the last system was solved.
  void finish(const State& end, State& into);
  /// f += the forces that contacts kept.
  void add_forces(Reals f) const;
  /// Impulses on the velocities at the end of a step of h, which join those forces in the memory of `into`.
  void strike(EndImpulses& impulses, double h, Reals v, State& into);
  /// A free rigid body, a sheet or a line met something at such a speed in this step, after it was finished,
  /// that it would go deeper than a tenth of the gap: its velocity has jumped.
  [[nodiscard]] bool struck() const;
  [[nodiscard]] std::size_t size() const { return run_.acting().size(); }
  /// The least distance, as a share of xi, of a pair that acts, at the end of the step; infinite for none.
  [[nodiscard]] double least_gap() const { return least_gap_; }
  /// How much nearer than it rests a pair that acts is then, as a share of the gap.
  [[nodiscard]] double deepest() const { return deepest_; }
  /// Forces hold surfaces apart at their gap, where springs give way.
  [[nodiscard]] virtual bool rests_at_gap() const { return true; }

 protected:
  /// It may press, so that it counts at its rows.
  [[nodiscard]] virtual bool may_press(std::size_t i) const = 0;
  /// Gives a contact of the latest look, number i, its normal force and stiffness. The normal force [N] that
  /// bounds its friction; nothing: it does not press.
  virtual std::optional<double> press(std::size_t i, ContactNumbers& contact) = 0;
  /// Adds friction of that bound [N]; k is the stiffness against sliding [N/m], and `share` what it is of
  /// that of the step's own matrix.
  virtual void rub(ContactNumbers& contact, double bound, double k, double share);

  [[nodiscard]] const ContactPair& pair_of(const ContactNumbers& contact) const {
    return contact_.description().pairs[static_cast<std::size_t>(contact.pair)];
  }
  /// A normal force [N], positive where it pushes, and its stiffness against coming nearer [N/m].
  static void give(ContactNumbers& contact, double force, double k);
  /// Its contacts have stiffnesses of their own, so that those of the rows are not looked for.
  [[nodiscard]] virtual bool has_own_stiffness() const { return false; }
  /// Before the contacts of a look press.
  virtual void begin_press() {}
  /// What k is of contacts of the latest look, of that matrix, in which contacts count by their shares.
  void find_stiffnesses(std::span<const double> blocks, double scale, std::span<const double> shares,
                        std::vector<double>& stiffnesses);
  /// k of the step's own matrix against coming nearer than a multiplier allows [N/m].
  [[nodiscard]] double hard_stiffness(std::size_t i) const { return normal_ * stiffnesses_[i]; }
  /// What that is of the stiffness of the step's own matrix there, of contacts that move nothing soft, and
  /// of those that were made stiffer in this step; else 0.
  [[nodiscard]] double share_of_stiffness(std::size_t i) const;
  /// So many systems of the step were solved.
  [[nodiscard]] int systems() const { return systems_; }
  /// Contacts of the latest look.
  [[nodiscard]] std::span<ContactNumbers> pressing() { return pressing_; }
  /// A contact is so much deeper than its multiplier allows, or open though it presses [m].
  void note_depth(const ContactNumbers& contact, double depth);

  /// It is of a rigid body, a sheet or a line.
  [[nodiscard]] bool stops_whole(const ContactNumbers& contact) const;
  /// Of the step [s].
  [[nodiscard]] double h() const { return h_; }
  /// Adds to a force and its stiffness.
  static void add(ContactNumbers& contact, const Vec3& force, const Mat3& H);

  const Contact& contact_;
  ContactRun run_;

 private:
  [[nodiscard]] bool is_carrier(std::int32_t row) const;
  [[nodiscard]] bool is_rigid(const ContactNumbers& contact) const;
  /// How many times stiffer than at first it is against coming nearer.
  [[nodiscard]] double stiffer(const ContactNumbers& contact) const;
  void press_all();
  [[nodiscard]] Mat3 compliance(const ContactNumbers& contact, std::span<const double> blocks) const;

  const FixedDofs& fixed_;
  BodyForces bodies_;
  ContactStage stage_;
  const State* start_ = nullptr;
  double h_ = 0.0;
  int systems_ = 0;
  std::span<const double> blocks_;
  double scale_ = 0.0;
  double normal_ = 1.0;                   ///< times stiffer
  double tangent_ = 1.0;                  ///< times stiffer
  double whole_ = 1.0;                    ///< times stiffer where something stops as a whole
  std::vector<ContactNumbers> pressing_;  ///< of the latest look
  std::vector<double> stiffnesses_;       ///< of what was looked at; shares where it has its own
  std::vector<double> shares_;            ///< of what was looked at: 1 where it may press
  std::vector<double> counts_;            ///< contacts of each row, by their shares
  double change_ = 0.0;                   ///< of the forces, at the latest look
  std::array<double, 3> changes_{};       ///< the same before the latest systems of this step, the last first
  int alternations_ = 0;                  ///< updates of this step that found contacts alternate, less others
  double inadmissible_ = 0.0;
  double depth_ = 0.0;
  double least_gap_ = 0.0;
  double deepest_ = 0.0;
};

}  // namespace tissu
