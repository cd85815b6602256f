#pragma once

/// Contact as one of a world's forces. What touches what, and how hard, stands in the memory of a state, so
/// that copies, roll-backs and checkpoints of the state hold it; `ContactRun` writes it.
///
/// A contact joins up to four vertices of surfaces with weights beta that sum to zero:
///
///     r = sum_k beta_k p_k      d = |r|      n = r / d      g = d - xi
///
/// xi is the distance at which the surfaces rest: half their thicknesses and the gap. While a system is
/// solved its force is linear in r: f = push - H (r - place). Between steps H is zero and `push` is the force
/// of the latest step.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "tissu/assembly/couplings.h"
#include "tissu/assembly/live_lead.h"
#include "tissu/contact/description.h"
#include "tissu/contact/merged_parts.h"
#include "tissu/contact/surface_set.h"
#include "tissu/contact/travel.h"
#include "tissu/force/force_model.h"

namespace tissu {

/// One contact as it stands in the memory: numbers alone.
struct ContactNumbers {
  static constexpr double kPlane = 4.0;  ///< a vertex before a plane; else a PairKind

  double kind = 0.0;
  double a = 0.0;      ///< the vertex, or the first edge
  double b = 0.0;      ///< the triangle, the second edge, the other vertex, or the obstacle that is a plane
  double point = 0.0;  ///< of a face or edge before something round, from 1 on; 0: the nearest
  double pair = 0.0;
  std::array<double, 4> vertex = {-1.0, -1.0, -1.0, -1.0};  ///< of the surfaces; -1: none
  std::array<double, 4> beta = {};
  std::array<double, 3> fixed =
      {};  ///< sum of beta p over vertices of obstacles, minus a point of a plane [m]
  std::array<double, 3> normal = {};
  std::array<double, 3> place = {};      ///< r at which the force is `push` [m]
  std::array<double, 3> push = {};       ///< [N]
  std::array<double, 6> stiffness = {};  ///< H: xx yy zz yz xz xy [N/m]
  double apart = 0.0;                    ///< xi [m]
  double force = 0.0;                    ///< lambda_n [N]
  std::array<double, 3> drag = {};       ///< lambda_T [N]
  double sliding = 0.0;                  ///< 1: friction gave way
  double area = 0.0;                     ///< on which it acts [m2]
  /// From each vertex to where it touches, in the axes of the rigid body that carries it or of the frame that
  /// it is [m]: what is round rolls. Zero for others.
  std::array<double, 12> offset = {};

  /// Its vertex number k is on the side of the vertex, or of the first edge.
  [[nodiscard]] bool is_of_first(std::size_t k) const {
    return k < (kind == static_cast<double>(PairKind::edge_edge) ? 2U : 1U);
  }
  /// What it is between: contacts of two looks with the same key are one contact.
  [[nodiscard]] std::tuple<double, double, double, double> key() const { return {kind, a, b, point}; }
};

/// The contacts that a memory holds.
class ContactTable {
 public:
  static constexpr std::size_t kNumbers = sizeof(ContactNumbers) / sizeof(double);
  explicit ContactTable(std::span<const double> numbers) : numbers_(numbers) {}
  [[nodiscard]] std::size_t size() const { return numbers_.size() / kNumbers; }
  [[nodiscard]] ContactNumbers operator[](std::size_t i) const;
  static void write(std::span<const ContactNumbers> contacts, std::vector<double>& numbers);
  /// In the place of contact i.
  static void write(const ContactNumbers& contact, std::size_t i, std::vector<double>& numbers);

 private:
  std::span<const double> numbers_;
};

class Contact final : public ForceModel {
 public:
  static constexpr std::string_view kMemory = "contact";  ///< name of their place in the memory

  /// `first_node`: the row of the first node of each of the description's bodies; `frames`: of the world;
  /// `rest`: all positions.
  Contact(ContactDescription description, std::span<const std::int32_t> first_node, ConstReals rest,
          std::span<const Frame> frames = {});

  [[nodiscard]] std::string_view effect() const override { return "contact"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  /// Where an obstacle is led, or springs store what is not counted.
  [[nodiscard]] bool may_add_energy() const override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  /// Of the linear force: zero between steps.
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

  [[nodiscard]] RunTime run_time() const override { return {.begins = true, .couples = true}; }
  void claim_memory(MemoryPlaces& places) override;
  /// Live leads of obstacles go on.
  void begin_step(State& state, Scratch& scratch, double h) const override;
  void add_couplings(const State& state, StiffnessScale scale, Couplings& couplings) const override;
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  void check_memory(const State& state) const override;

  // After an edit in place.
  /// The same contact with other surfaces of its bodies. Pairs, obstacles and places in the memory stay.
  [[nodiscard]] std::unique_ptr<Contact> with_surfaces(ContactDescription description,
                                                       std::span<const std::int32_t> first_node,
                                                       ConstReals rest, std::span<const Frame> frames) const;
  /// Gives its surfaces to such a one, and takes those of that.
  void exchange_surfaces(Contact& other);
  /// A state that remembers what `before` was in contact with goes on with these surfaces.
  void follow(const Contact& before, State& state) const;

  [[nodiscard]] const ContactDescription& description() const { return description_; }
  [[nodiscard]] const SurfaceSet& surfaces() const { return surfaces_; }
  [[nodiscard]] std::vector<double>& numbers(State& state) const { return state.memory[place_]; }
  [[nodiscard]] ContactTable table(const State& state) const { return ContactTable(state.memory[place_]); }

  // Obstacles, at a time of the run that a state is in.
  [[nodiscard]] Vec3 place_of(std::int32_t obstacle, const Vec3& rest, const State& state, double time) const;
  /// Where the point is at time `to` that stands at `place` at time `from`.
  [[nodiscard]] Vec3 carried(std::int32_t obstacle, const Vec3& place, const State& state, double from,
                             double to) const;
  [[nodiscard]] Vec3 normal_of(std::int32_t obstacle, const State& state, double time) const;
  /// By which rotation vector an obstacle that is led turns between two times, whole turns and all.
  [[nodiscard]] Vec3 turn_of(std::int32_t obstacle, const State& state, double from, double to) const;
  /// Of the obstacle with that name; -1: none.
  [[nodiscard]] std::int32_t obstacle_named(std::string_view name) const;
  /// Of a free obstacle; null: it is led or at rest.
  [[nodiscard]] const SurfaceCarrier* carrier_of(std::int32_t obstacle) const;
  /// Leads an obstacle from where it is to a pose, over so many seconds from the next step on; 0: in that
  /// step. Refuses an unknown name.
  void lead_to(std::string_view name, const Pose& pose, double over, State& state) const;
  /// Leads it back to its own path.
  void release(std::string_view name, double over, State& state) const;
  [[nodiscard]] bool is_led_live(std::string_view name, const State& state) const;
  [[nodiscard]] bool is_any_led_live(const State& state) const;
  /// The pose, from rest, in which an obstacle is.
  [[nodiscard]] Pose pose_of(std::int32_t obstacle, const State& state, double time) const;

  /// Where a state has a vertex that unknowns move.
  [[nodiscard]] Vec3 place(std::int32_t vertex, const State& state) const {
    const SurfaceVertex& v = surfaces_.vertices()[static_cast<std::size_t>(vertex)];
    return v.row >= 0 ? Vec3(block(ConstReals(state.positions), v.row)) : carried_place(vertex, state);
  }
  /// Calls f(part) for every row that a contact moves with, with its weight: motion = sum part.motion(p).
  template <class Function>
  void for_parts(const ContactNumbers& contact, const State& state, Function&& f) const {
    if (!surfaces_.has_riders() || !rides(contact)) {
      for_each_part(contact, state, f);
    } else if (surfaces_.has_turning_riders()) {
      for_merged_parts<MergedTurningParts>(contact, state, f);
    } else {
      for_merged_parts<MergedParts>(contact, state, f);
    }
  }
  /// The surface of a line turns about that vertex with a frame.
  [[nodiscard]] bool rolls(const ContactNumbers& contact, const SurfaceVertex& vertex) const {
    return vertex.roller >= 0 && description_.pairs[static_cast<std::size_t>(contact.pair)].friction > 0.0;
  }
  /// Number in State::rotations of what turns the surface of what is round about a vertex; -1: nothing.
  [[nodiscard]] std::int32_t frame_of(const ContactNumbers& contact, const SurfaceVertex& vertex) const {
    if (vertex.carrier >= 0) return surfaces_.carriers()[static_cast<std::size_t>(vertex.carrier)].frame;
    return rolls(contact, vertex) ? surfaces_.roller(vertex).frame : -1;
  }
  /// From a contact's vertex number k to where it touches: on the surface of what is round.
  [[nodiscard]] Vec3 outward(const ContactNumbers& contact, std::size_t k) const {
    const double radius = surfaces_.vertices()[static_cast<std::size_t>(contact.vertex[k])].radius;
    const Vec3 n(contact.normal[0], contact.normal[1], contact.normal[2]);
    return (contact.is_of_first(k) ? -radius : radius) * n;
  }
  /// Where the force on a contact's vertex number k acts: on the surface of what is round and turns. Sheets,
  /// lines whose nodes are not frames, and lines without friction have it on their middle.
  [[nodiscard]] Vec3 touched(const ContactNumbers& contact, std::size_t k, const State& state) const;
  /// r of a contact in a state.
  [[nodiscard]] Vec3 reach(const ContactNumbers& contact, const State& state) const;
  /// What of r comes from the turning of round things since the contact was looked at. What is round touches
  /// elsewhere when it turns, so that only the part along the surfaces counts.
  [[nodiscard]] Vec3 rolled(const ContactNumbers& contact, const State& state) const;
  /// How r of a contact changes by motions p of the rows, of arms as a state has them.
  [[nodiscard]] Vec3 motion(const ContactNumbers& contact, const State& state, ConstReals p) const;

  /// All vertices of the surfaces, three numbers each.
  void place_vertices(const State& state, double time, Reals places) const;
  /// f -= the forces of the contacts of a state.
  void take_force(const State& state, Reals f) const;
  /// Force [N], and moment about its origin [N m], that the contacts of a state give to a body or obstacle.
  struct Wrench {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
  };
  /// Of a step that was taken in parts the mean over the step.
  [[nodiscard]] Wrench force_on(std::int32_t surface, const State& state) const;
  /// `state` is the end of a part of a step that counts for so much of it.
  void add_part(double share, State& state) const;

 private:
  template <class Function>
  void for_contacts(const State& state, Function&& f) const;
  /// What is left of contacts of other surfaces, by the numbers of these.
  [[nodiscard]] std::vector<ContactNumbers> carried_from(const SurfaceSet& before,
                                                         const ContactTable& then) const;
  /// Several rows carry a vertex of it.
  [[nodiscard]] bool rides(const ContactNumbers& contact) const {
    for (const double vertex : contact.vertex) {
      if (vertex >= 0.0 && surfaces_.vertices()[static_cast<std::size_t>(vertex)].rider >= 0) return true;
    }
    return false;
  }
  template <class Merged, class Function>
  void for_merged_parts(const ContactNumbers& contact, const State& state, Function&& f) const {
    Merged merged;
    for_each_part(contact, state, [&](const CarriedPart& part) { merged.add(part); });
    for (const CarriedPart& part : merged.all()) f(part);
  }
  /// Calls f(part) for every row that carries a vertex of a body, and for rotations beside them.
  template <class Function>
  void for_rows_of(const SurfaceVertex& vertex, double weight, const State& state, Function&& f) const {
    for (const RiderPart& part : surfaces_.parts(vertex)) {
      f(CarriedPart{part.row, weight * part.weight});
    }
    const std::span<const RiderTurn> turns = surfaces_.turns(vertex);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const RiderTurn& turn = turns[i];
      if (turn.frame < 0) continue;
      const Vec3 arm = state.rotations[static_cast<std::size_t>(turn.frame)] * turn.arm;
      f(CarriedPart{turn.row, weight * surfaces_.parts(vertex)[i].weight, arm, true});
    }
  }
  template <class Function>
  void for_each_part(const ContactNumbers& contact, const State& state, Function&& f) const {
    for (std::size_t k = 0; k < 4; ++k) {
      if (contact.vertex[k] < 0.0 || contact.beta[k] == 0.0) continue;
      const auto vertex = static_cast<std::int32_t>(contact.vertex[k]);
      const SurfaceVertex& v = surfaces_.vertices()[static_cast<std::size_t>(vertex)];
      if (v.row >= 0) {
        f(CarriedPart{v.row, contact.beta[k]});
        if (!rolls(contact, v)) continue;
        f(CarriedPart{surfaces_.roller(v).rotation, contact.beta[k], outward(contact, k), true});
      } else if (v.carrier >= 0) {
        const SurfaceCarrier& carrier = surfaces_.carriers()[static_cast<std::size_t>(v.carrier)];
        f(CarriedPart{carrier.row, contact.beta[k]});
        f(CarriedPart{carrier.rotation, contact.beta[k], arm(contact, k, carrier, state), true});
      } else if (v.rider >= 0) {
        for_rows_of(v, contact.beta[k], state, f);
      }
    }
  }
  [[nodiscard]] Vec3 carried_place(std::int32_t vertex, const State& state) const;
  std::int32_t carry_rider(const SurfaceVertex& vertex, const State& state, Couplings& couplings) const;
  /// From the origin of the rigid body that carries the vertex, in space [m].
  [[nodiscard]] Vec3 arm(std::int32_t vertex, const SurfaceCarrier& carrier, const State& state) const {
    return state.rotations[static_cast<std::size_t>(carrier.frame)] * surfaces_.arm(vertex);
  }
  /// From there to where a contact's vertex number k touches.
  [[nodiscard]] Vec3 arm(const ContactNumbers& contact, std::size_t k, const SurfaceCarrier& carrier,
                         const State& state) const {
    return arm(static_cast<std::int32_t>(contact.vertex[k]), carrier, state) + outward(contact, k);
  }
  void scatter(const ContactNumbers& contact, const State& state, const Vec3& force, Reals f) const;
  [[nodiscard]] LivePlace live_place(std::int32_t obstacle, const State& state, double time) const;
  void begin_way(std::int32_t obstacle, bool released, const Pose& target, double over, State& state) const;
  [[nodiscard]] std::int32_t required(std::string_view name) const;

  ContactDescription description_;
  SurfaceSet surfaces_;
  [[nodiscard]] Wrench force_now(std::int32_t surface, const State& state) const;

  std::size_t place_ = 0;           ///< in State::memory
  std::size_t parts_ = 0;           ///< in State::memory: wrenches of the parts of a step, by surface
  std::vector<std::size_t> leads_;  ///< of each obstacle, its live lead's
};

Mat3 stiffness_of(const ContactNumbers& contact);
inline Vec3 vector_of(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }
inline std::array<double, 3> numbers_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace tissu
