#pragma once

/// Where contacts are during the steps of one run: it looks for them, hands on what they remember, and keeps
/// ways free. What presses, and how hard, is said by a response: `ImplicitContact`, `ExplicitContact`.

#include <memory>
#include <span>
#include <vector>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/assembly/mass.h"
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

  /// A step begins at `start`, which outlives it, and ends at the time `end`; `led` has given rows and
  /// rotations where they are then. What is led goes there first, and pushes what is in its way.
  void begin(const State& start, double end, const State& led);
  /// How far obstacles are led in such a step, in half mean edges of the finest body.
  [[nodiscard]] double half_edges_led(const State& start, double end) const;
  /// A multiplier whose vertex has no contact any more goes to those of the vertices that it was shared with.
  void hand_over_to_all() { hands_to_all_ = true; }
  /// Every near vertex and face, and every two near edges, are a contact, wherever on them they are nearest:
  /// the square of such a distance has no kinks. Two edges count by the angle between them where ways begin.
  void take_every_pair() { every_pair_ = true; }
  /// The step is a part of one that was asked for. What was too deep at its start opens by that share of its
  /// depth, so that the depth of a step is given back as velocity once, however short its parts are. Only
  /// after `open_by_shares`.
  void take_part(double share) { share_ = share; }
  void open_by_shares() { opens_by_shares_ = !contact_.surfaces().carriers().empty(); }
  [[nodiscard]] bool opens_by_shares() const { return opens_by_shares_; }
  /// A pair of one surface that a look finds nearer than it is to rest, although no contact was there and it
  /// was so near at the start of the step, rests where it was then, until it has opened.
  void begin_late() { begins_late_ = true; }
  /// Puts rows where ways begin: at the start of the step, or where what is led pushed them.
  void stand(State& at) const;
  /// Shortens the ways from the start to `to` until nothing passes through anything. The number of rows that
  /// were held back.
  int hold_back(State& to);
  /// What flies together goes on together: ways that were cut by the latest `hold_back` lose only what they
  /// have beside the mean way of what stops each other, where that is long, and as long as nothing else is in
  /// the way then. `whole`: positions without cuts, of `to`.
  void go_on_together(const Mass& mass, const FixedDofs& fixed, ConstReals whole, State& to);
  /// Rows whose ways were cut by the latest `hold_back` have the velocities `v` of what is left of them, in
  /// the place of `before`. What rigid bodies stop each other gets the momentum back that is lost by that,
  /// each island as a whole; what something given stops, such as an obstacle, does not.
  void keep_momentum(const Mass& mass, const FixedDofs& fixed, ConstReals before, Reals v);
  /// The least share of its way that the latest `hold_back` left to anything.
  [[nodiscard]] double least_share() const { return least_share_; }
  /// Of the ways of what is free to `to` [m].
  [[nodiscard]] double longest_way(const State& to) const;
  /// Ways go on from `at`, to which the way was free, and not from the start of the step any more.
  void go_on_from(const State& at) {
    gather(at, from_);
    from_turned_ = at.rotations;
  }

  /// Contacts at the places of `at`, with the multipliers of those that act. `holds_on`: those that press are
  /// found however far they have opened.
  void look(const State& at, bool holds_on);
  [[nodiscard]] bool holds_on() const { return holds_on_; }
  /// Contacts at the places of `at`, on ways that lead to `goal`; null: at places where ways were cut, with
  /// what stopped them beside what the narrow phase finds.
  void detect(const State& at, const State* goal);
  [[nodiscard]] std::span<const ContactNumbers> looked() const { return looked_; }
  /// Of a contact of the latest look: its distance less that at which it rests [m], and how much it counts.
  [[nodiscard]] double gap(std::size_t i) const { return gaps_[i]; }
  [[nodiscard]] double weight(std::size_t i) const { return weights_[i]; }
  /// It is shut where the latest ways were to lead, whatever the gap is now.
  [[nodiscard]] bool is_predicted(std::size_t i) const { return predicted_[i] != 0; }

  /// The contacts that act: those of the start of the step at first. The next look takes over their
  /// multipliers.
  [[nodiscard]] std::vector<ContactNumbers>& acting() { return contacts_; }
  [[nodiscard]] const std::vector<ContactNumbers>& acting() const { return contacts_; }

  /// How r of a contact has changed from the start of the step to its place in the latest look, …
  [[nodiscard]] Vec3 gone(const ContactNumbers& contact) const;
  /// … or to the places and the time of `at`, …
  [[nodiscard]] Vec3 gone(const ContactNumbers& contact, const State& at) const;
  /// … what obstacles alone have of it at the end, …
  [[nodiscard]] Vec3 led(const ContactNumbers& contact) const;
  /// … and how fast it changes by the velocities of rows at the start.
  [[nodiscard]] Vec3 rate(const ContactNumbers& contact, ConstReals velocities) const;
  /// Calls f(part) for every row that a contact moves with, of arms as the start of the step has them.
  template <class Function>
  void for_parts(const ContactNumbers& contact, Function&& f) const {
    contact_.for_parts(contact, *start_, f);
  }
  [[nodiscard]] std::size_t bytes() const;

 private:
  void gather(const State& state, std::vector<double>& places) const;
  // led_turns.cpp
  void list_round();
  void turn_led();
  [[nodiscard]] Vec3 turned_by(const ContactNumbers& contact) const;
  void find();
  /// Those that a look has to see: ways that were cut are not gone together.
  [[nodiscard]] Candidates& near();
  void find_pairs();
  void find_planes();
  void add(const Candidate& candidate, const Found& found, std::int32_t point);
  [[nodiscard]] bool is_row_given(std::int32_t row) const;
  void list_given();
  // contact_ways.cpp
  void measure_ways(const State& to);
  void bend(const State& to);
  void sway(const State& to);
  void add_arcs();
  int hold_back_rotations(State& to);
  struct HeldRow;
  template <class Function>
  void for_held_rows(Function&& f) const;
  void gather_inner_rows(const State& state, std::vector<double>& places) const;
  [[nodiscard]] Vec3 way_turned(std::int32_t frame, const State& to) const;
  int hold_back_carriers(State& to);
  void set_offsets(ContactNumbers& c) const;
  bool find_plainly(const Candidate& candidate, double reach, Found& found) const;
  [[nodiscard]] const ContactNumbers* acting(const ContactNumbers& c) const;
  [[nodiscard]] bool is_held_on(const ContactNumbers& c) const;
  [[nodiscard]] bool is_held_on(const Candidate& candidate) const;
  void keep_multipliers();
  void rest_where_begun();
  [[nodiscard]] bool is_in_crease(const ContactNumbers& contact) const;
  void open_slowly();
  [[nodiscard]] double distance_at_begin(const ContactNumbers& contact) const;
  void hand_over();
  bool hand_to(double vertex, std::int32_t other, double sign, const ContactNumbers& before);
  [[nodiscard]] Vec3 reach(const ContactNumbers& contact, ConstReals places) const;

  const Contact& contact_;
  const FixedDofs& fixed_;
  std::vector<std::uint8_t> given_;  ///< of each mover, and of vertices that rows carry
  std::vector<std::uint8_t> led_;    ///< the same of places alone, whatever rotations do
  std::unique_ptr<Candidates> candidates_;
  std::unique_ptr<Candidates> together_;  ///< of ways that are gone whole; null: they would be the same
  std::unique_ptr<HoldBack> held_;
  std::unique_ptr<PushAhead> ahead_;
  std::vector<PlacedPlane> planes_;
  std::vector<std::int32_t> round_;  ///< obstacles that are led, if they are, and have a radius
  std::vector<Vec3> led_turns_;      ///< of each obstacle: the rotation vector of its turn in the step
  bool turns_led_ = false;           ///< one of them is not zero
  // Places of all vertices, then of rows that carry some and are none:
  std::vector<double> begin_;   ///< at the start of the step, …
  std::vector<double> from_;    ///< … after what is led went ahead, …
  std::vector<double> now_;     ///< … and where they are looked at
  std::vector<double> bends_;   ///< of each vertex, as HoldBack takes them; empty: nothing free is rigid
  std::vector<double> sways_;   ///< of each vertex, as HoldBack takes them; empty: rows carry none
  std::vector<double> leaves_;  ///< the same with arcs: how far a vertex may leave its straight way [m]
  std::vector<Quaternion> from_turned_;  ///< rotations where ways begin
  std::vector<double> goal_;             ///< where the latest system led them, before they were held back
  std::vector<double> placed_;           ///< rows where ways were cut to
  const State* start_ = nullptr;
  const State* looked_at_ = nullptr;
  double end_ = 0.0;
  bool plainly_ = true;
  bool every_pair_ = false;
  bool hands_to_all_ = false;
  bool begins_late_ = false;
  bool holds_on_ = false;  ///< in the latest look
  bool opens_by_shares_ = false;
  double share_ = 1.0;  ///< of the step that was asked for
  double least_share_ = 1.0;
  std::vector<ContactNumbers> contacts_;
  std::vector<ContactNumbers> looked_;
  std::vector<double> gaps_;             ///< of looked_
  std::vector<std::uint8_t> predicted_;  ///< of looked_
  std::vector<double> lost_;             ///< of each island: mass and momentum, four numbers
  std::vector<double> weights_;          ///< of looked_
  std::vector<std::int32_t> order_;      ///< of contacts_, by their keys
  std::vector<std::uint8_t> met_;        ///< of contacts_: found again in the latest look
  std::vector<std::int32_t> heirs_;      ///< of looked_: contacts of a vertex, by the vertex
};

}  // namespace tissu
