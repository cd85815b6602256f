#pragma once

/// Contact during the steps of one run: it looks, says how stiff contacts are, keeps ways free, and updates
/// multipliers (augmented Lagrangian: Alart and Curnier 1991, Computer Methods in Applied Mechanics and
/// Engineering 92, 353-375).
///
///     normal      t = lambda_n - k g          f_n = <t> n,  H_n = k n n^T where t > 0
///     friction    t_T = lambda_T - k u_T      f_T = t_T on the disk of radius F = mu <t>
///     after each solve  lambda_n <- n . f,  lambda_T <- f_T on the disk
///
/// k = 3 a / (move push), 1/a = |sum_r N_r beta_r^2 A_rr^-1| with the blocks A_rr of the step's own matrix
/// and the contacts N_r at a row: the couplings never exceed three times the block diagonal of A, whatever
/// the scene.

#include <memory>
#include <span>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/contact/contact.h"

namespace tissu {

class Candidates;
class HoldBack;
class PushAhead;
struct Candidate;
struct Found;
struct PlacedPlane;

class ContactRun {
 public:
  ContactRun(const Contact& contact, const FixedDofs& fixed);
  ~ContactRun();
  ContactRun(const ContactRun&) = delete;
  ContactRun& operator=(const ContactRun&) = delete;

  /// A step begins at `start` and ends at the time `end`; `led` holds the places of given rows then. What is
  /// led goes there first, and pushes what is in its way. Forces on a body are judged by a thousandth of
  /// its `load` [N] where they are smaller; `load` may be empty.
  void begin(const State& start, double end, ConstReals led, ConstReals load);
  /// How far obstacles are led in such a step, in half mean edges of the finest body.
  [[nodiscard]] double half_edges_led(const State& start, double end) const;
  /// The diagonal blocks of the step's matrix without contact, [row][9], and move times push: they outlive
  /// the step.
  void set_matrix(std::span<const double> blocks, double scale);
  /// How many times stiffer than that contacts are against coming nearer, and against sliding: 1, as at
  /// first.
  void set_stiffer(double normal, double tangent);
  /// A multiplier whose vertex has no contact any more goes to those of the vertices that it was shared with.
  void hand_over_to_all() { hands_to_all_ = true; }
  /// Shortens the ways from the start to `to` until nothing passes through anything. The number of rows that
  /// were held back.
  int hold_back(State& to);
  /// The least share of its way that the latest `hold_back` left to anything.
  [[nodiscard]] double least_share() const { return least_share_; }
  /// Ways go on from `at`, to which the way was free, and not from the start of the step any more.
  void go_on_from(const State& at) { gather(at, from_); }
  /// Contacts at the places of `at`, with the multipliers of those that were there before. By how much their
  /// forces differ from those of the latest solve, as a share.
  double look(const State& at);
  /// How far contacts that act are inside each other, as a share of the gap, at the latest look.
  [[nodiscard]] double depth() const { return depth_; }
  /// A system was solved with the contacts of the latest look, and led to `end`: multipliers become the
  /// forces there.
  void update(const State& end);
  /// The part of the forces with which that system was solved that no contact can give, since it pulls or
  /// lies beyond Coulomb's disk: on the body where it is the
  /// largest share of the rest of them.
  [[nodiscard]] double inadmissible() const { return inadmissible_; }
  /// The contacts of the latest look are those that act from now on.
  void take() { contacts_.swap(looked_); }
  /// The contacts that act, into the memory of a state.
  void write(State& state) const;
  /// The step is over: contacts keep the forces with which the last system was solved.
  void finish(State& end);
  [[nodiscard]] std::size_t size() const { return contacts_.size(); }
  /// The least distance, as a share of xi, of a pair that acts, at the end of the step; infinite for none.
  [[nodiscard]] double least_gap() const { return least_gap_; }
  [[nodiscard]] std::size_t bytes() const;

  // Of explicit steps, whose responses are their own (contact_detect.cpp).
  /// Contacts at the places of `at`, on ways that lead to `goal`; null: at places where ways were cut, with
  /// what stopped them beside what the narrow phase finds.
  void detect(const State& at, const State* goal);
  [[nodiscard]] std::span<const ContactNumbers> looked() const { return looked_; }
  /// Of a contact of the latest look: its distance less that at which it rests [m], and how much it counts.
  [[nodiscard]] double gap(std::size_t i) const { return gaps_[i]; }
  [[nodiscard]] double weight(std::size_t i) const { return weights_[i]; }
  /// How r of a contact has changed from the start of the step to the places and the time of `at`, …
  [[nodiscard]] Vec3 gone(const ContactNumbers& contact, const State& at) const;
  /// … what obstacles alone have of it at the end, …
  [[nodiscard]] Vec3 led(const ContactNumbers& contact) const;
  /// … and how fast it changes by the velocities of rows.
  [[nodiscard]] Vec3 rate(const ContactNumbers& contact, ConstReals velocities) const;
  /// r of a contact, of rows at the places of `at`.
  [[nodiscard]] Vec3 reach_of(const ContactNumbers& contact, const State& at) const;
  [[nodiscard]] std::int32_t row_of(double vertex) const { return row(vertex); }

 private:
  void gather(const State& state, std::vector<double>& places) const;
  void find();
  void find_pairs();
  void find_planes();
  void add(const Candidate& candidate, const Found& found, std::int32_t point);
  bool find_plainly(const Candidate& candidate, double reach, Found& found) const;
  [[nodiscard]] const ContactNumbers* acting(const ContactNumbers& c) const;
  void keep_multipliers();
  void hand_over();
  bool hand_to(double vertex, std::int32_t other, double sign, const ContactNumbers& before);
  void stiffen();
  void press();
  double change();
  /// Squares of forces on rows, summed for each body.
  void sum_squares(ConstReals forces, std::vector<double>& squares) const;
  void add_squares(const ContactNumbers& contact, double square, std::vector<double>& squares) const;
  /// The largest |part| / |whole| of a body; each body's floor counts as a part of its whole.
  [[nodiscard]] double largest_share(ConstReals parts, ConstReals wholes) const;
  void scatter(const ContactNumbers& contact, const Vec3& force, Reals f) const;
  void rub(ContactNumbers& contact, const Vec3& n, double t, const Vec3& at, double k) const;
  /// It has a multiplier, or is shut, or will be.
  [[nodiscard]] bool may_press(std::size_t i) const {
    return looked_[i].force > 0.0 || gaps_[i] < 0.0 || predicted_[i] != 0;
  }
  [[nodiscard]] Mat3 compliance(const ContactNumbers& contact) const;
  [[nodiscard]] std::int32_t row(double vertex) const;
  [[nodiscard]] Vec3 reach(const ContactNumbers& contact, ConstReals places) const;

  const Contact& contact_;
  const FixedDofs& fixed_;
  std::vector<std::uint8_t> given_;  ///< of each vertex
  std::unique_ptr<Candidates> candidates_;
  std::unique_ptr<HoldBack> held_;
  std::unique_ptr<PushAhead> ahead_;
  std::vector<PlacedPlane> planes_;
  std::vector<double> begin_;  ///< places of all vertices at the start of the step, …
  std::vector<double> from_;   ///< … after what is led went ahead, …
  std::vector<double> now_;    ///< … and where they are looked at
  std::vector<double> goal_;   ///< where the latest system led them, before they were held back
  const State* start_ = nullptr;
  double end_ = 0.0;
  bool plainly_ = true;
  std::span<const double> blocks_;
  double scale_ = 0.0;
  bool hands_to_all_ = false;
  double normal_ = 1.0;   ///< times stiffer
  double tangent_ = 1.0;  ///< times stiffer
  std::vector<ContactNumbers> contacts_;
  std::vector<ContactNumbers> looked_;
  std::vector<double> gaps_;             ///< of looked_
  std::vector<std::uint8_t> predicted_;  ///< of looked_: shut at the goal, whatever the gap is now
  std::vector<double> weights_;          ///< of looked_
  std::vector<double> stiffnesses_;      ///< of looked_
  std::vector<std::int32_t> order_;      ///< of contacts_, by their keys
  std::vector<std::uint8_t> met_;        ///< of contacts_: found again in the latest look
  std::vector<std::int32_t> heirs_;      ///< of looked_: contacts of a vertex, by the vertex
  std::vector<std::int32_t> counts_;     ///< contacts of each row
  std::vector<double> forces_;           ///< on rows
  std::vector<double> refusals_;         ///< on rows, of the latest update: what was taken off
  int alternations_ = 0;                 ///< updates of this step that found much inadmissible, less others
  double inadmissible_ = 0.0;
  double depth_ = 0.0;
  std::vector<double> floors_;   ///< of each body [N]
  std::vector<double> sizes_;    ///< squares on each body: of the forces before, …
  std::vector<double> others_;   ///< … of those after, …
  std::vector<double> changes_;  ///< … and of what changed
  double least_gap_ = 0.0;
  double least_share_ = 1.0;
};

}  // namespace tissu
