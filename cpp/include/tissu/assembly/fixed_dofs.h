#pragma once

/// Degrees of freedom whose motion is given: fixed nodes and nodes that are led.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/assembly/live_lead.h"
#include "tissu/state/memory.h"
#include "tissu/state/state.h"

namespace tissu {

/// A rigid motion given at a few times, linear between them and held before the first and after the last:
/// rotation by `angles` about `axis` through `center`, then displacement.
struct Motion {
  std::vector<double> times;        ///< ascending [s]; empty: at rest for ever
  std::vector<Vec3> displacements;  ///< [m]
  std::vector<double> angles;       ///< [rad]
  Vec3 center = Vec3::Zero();       ///< [m]
  Vec3 axis = Vec3::UnitX();        ///< of length 1

  [[nodiscard]] Vec3 position(const Vec3& rest, double time) const;
  /// The angle at `time`, turns and all [rad].
  [[nodiscard]] double angle(double time) const;
  /// The displacement at `time` [m].
  [[nodiscard]] Vec3 displacement(double time) const;
  [[nodiscard]] Pose pose(double time) const { return {center, displacement(time), axis, angle(time)}; }
};

/// The way of led nodes in a static step, from `start` to where their motion is at the time `to`. They go
/// along their motion, so that a rotation goes along its arc. What the motion asks for at the time `from`
/// already is applied in proportion: as a share of the motion from rest, else on the straight way.
struct LedWay {
  double from = 0.0;  ///< [s]
  double to = 0.0;    ///< [s]
  bool is_from_rest = false;
  [[nodiscard]] double time(double share) const { return share == 1.0 ? to : from + share * (to - from); }
};

class FixedDofs {
 public:
  static constexpr std::uint8_t kAllAxes = 7;

  FixedDofs() = default;
  explicit FixedDofs(std::int32_t rows) : masks_(static_cast<std::size_t>(rows), 0) {}

  /// Gives the motion of the axes in `mask` (x=1 y=2 z=4) of some nodes, whose rest positions are given too.
  /// With a name they are a support that may be led live, together with all others of that name.
  void add(std::span<const std::int32_t> nodes, ConstReals rest_positions, std::uint8_t mask,
           const Motion& motion, std::string_view name = {});

  /// Gives the rotation of some frames: their rotations' blocks, and their numbers in the state.
  void add_rotations(std::span<const std::int32_t> blocks, std::span<const std::int32_t> frames,
                     std::span<const Quaternion> rest, const Motion& motion, std::string_view name = {});
  /// Holds the rotation of some frames about the axes of space in `mask`: they do not turn about these.
  void hold_turning(std::span<const std::int32_t> blocks, std::uint8_t mask);

  // After an edit in place. The rows belong to no support that has a name.
  /// Supports of the same names keep their places in the memory.
  void keep_places(const FixedDofs& before);
  /// Rows that follow each other are free from now on.
  void free_rows(std::int32_t first, std::int32_t count);
  /// Holds free rows at given places, three numbers each.
  void hold_at(std::span<const std::int32_t> rows, ConstReals places);

  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] const std::vector<std::int32_t>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<std::uint8_t>& masks() const { return masks_; }

  /// Sets the led components of v so that a state moved by h v is where they are to be at `time`; `share` < 1
  /// goes only that part of the way.
  void set_velocities(const State& from, double time, double h, double share, Reals v) const;
  /// Sets the led components of `way` to what leads `now` to where they are at that share of the way from
  /// `start`. `before` is the share at which `now` stands: the turn by which a rotation goes on follows from
  /// it.
  void set_way(const LedWay& way, const State& start, double before, double share, const State& now,
               Reals change) const;
  /// Something is led: it has a motion, in the scene or by a live target.
  [[nodiscard]] bool moves() const;
  [[nodiscard]] bool moves(const State& state) const { return moves() || is_led_live(state); }
  /// The largest angle by which a motion turns on that way [rad].
  [[nodiscard]] double largest_turn(const LedWay& way, const State& start) const;
  /// The led places and rotations of `to` are those of `from` moved by h v.
  void place(const State& from, double h, ConstReals v, State& to) const;
  /// to = from in the led components.
  void copy(ConstReals from, Reals to) const;
  /// Zero in the led components.
  void clear(Reals values) const;

  // Live targets of named supports, in the memory of states: live_supports.cpp.
  /// A support has a live target, or is on its way back from one.
  [[nodiscard]] bool is_led_live(const State& state) const;
  /// Nodes of a support, in the order in which they were added; refuses a name that no support has.
  [[nodiscard]] std::vector<std::int32_t> nodes_of(std::string_view name) const;
  /// Leads a support from where it is to a pose, over so many seconds from the next step on; 0: in that step.
  /// `positions`, three for each node, are in place of the pose, and rotations stay as they are.
  void lead_to(std::string_view name, const Pose& pose, double over, State& state) const;
  void lead_to(std::string_view name, ConstReals positions, double over, State& state) const;
  /// Leads a support back to its own path; one that is not led live stays as it is.
  void release(std::string_view name, double over, State& state) const;
  /// Where each node of a support is led to: three numbers each, after a way, or now on its own path.
  [[nodiscard]] std::vector<double> target_of(std::string_view name, const State& state) const;
  [[nodiscard]] bool is_led_live(std::string_view name, const State& state) const;

  void claim_memory(MemoryPlaces& places);
  /// Once a step of h [s], before anything reads the state.
  void begin_step(State& state, double h) const;
  void carry_memory(const FixedDofs& before, const Memory& then, Memory& now) const;
  void check_memory(const State& state) const;

 private:
  struct Led {
    std::int32_t node;
    std::uint8_t mask;
    std::int32_t motion;
    Vec3 rest;
  };
  struct HeldTurning {
    std::int32_t block;
    std::uint8_t mask;
  };
  struct LedRotation {
    std::int32_t block;
    std::int32_t frame;
    std::int32_t motion;
    Quaternion rest;
  };
  void lead(std::span<const std::int32_t> rows, std::uint8_t mask);
  LiveSupport& support_named(std::string_view name);
  [[nodiscard]] const LiveSupport& support(std::string_view name) const;
  [[nodiscard]] const Motion& own_motion(const LiveSupport& support) const;
  [[nodiscard]] LiveLead lead_of(const LiveSupport& support, const State& state) const;
  [[nodiscard]] LivePlace place_of(const LiveSupport& support, const LiveLead& lead, double time) const;
  [[nodiscard]] Vec3 position(const LiveSupport& support, const LiveLead& lead, const LivePlace& place,
                              std::size_t i, double time) const;
  LiveLeadNumbers begin_way(const LiveSupport& support, bool released, double over, State& state) const;
  void set_live_velocities(const State& from, double time, double h, double share, Reals v) const;
  void set_live_way(const LedWay& way, const State& start, double before, double share, const State& now,
                    Reals change) const;
  [[nodiscard]] double largest_live_turn(const LedWay& way, const State& start) const;

  std::vector<std::int32_t> rows_;
  std::vector<std::uint8_t> masks_;
  std::vector<Led> led_;
  std::vector<LedRotation> led_rotations_;
  std::vector<HeldTurning> held_turnings_;
  std::vector<Motion> motions_;
  std::vector<LiveSupport> live_;
};

/// The value at `time` of a table, linear between its times, held at its ends; `empty_value` when it is
/// empty.
double interpolate(std::span<const double> times, std::span<const double> values, double time,
                   double empty_value);

}  // namespace tissu
