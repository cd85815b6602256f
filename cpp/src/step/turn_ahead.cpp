#include "tissu/step/turn_ahead.h"

#include <algorithm>
#include <cmath>

#include "rigid_motions.h"

namespace tissu {
namespace {

constexpr double kLeast = 1e-4;     ///< [rad] in a step: less strains by a part of 10^8
constexpr double kTogether = 1e-9;  ///< of the extent: supports that come no farther apart move as one
constexpr double kFarthest = 1.0;   ///< [rad] in a step: where a faster part turns is not known

/// The motion of a twist that stays as it is: x -> center + rotation (x - center) + way.
struct Advance {
  Mat3 rotation;
  Vec3 way;
  [[nodiscard]] Vec3 move(const Vec3& arm) const { return rotation * arm + way - arm; }
};

/// A rigid motion from the start of the step on.
struct Turning {
  RigidMotions::Twist twist;
  Vec3 carried;  ///< [m/s] velocity of the supports
  bool is_held;

  /// A point on the axis of a part that is held stays where it is; the mass centre of a free one goes
  /// straight.
  [[nodiscard]] Advance after(double seconds) const {
    const Vec3 turn = seconds * twist.spin;
    Vec3 way = seconds * twist.velocity;
    const double angle = turn.norm();
    if (is_held && angle > 0.0) {
      const Vec3 axis = turn / angle;
      const Vec3 across = axis.cross(way);
      way += (1.0 - std::cos(angle)) / angle * across + (1.0 - std::sin(angle) / angle) * axis.cross(across);
    }
    return {turn_by(turn).toRotationMatrix(), way + seconds * carried};
  }
  [[nodiscard]] Vec3 velocity(const Vec3& arm) const {
    return carried + twist.velocity + twist.spin.cross(arm);
  }
  [[nodiscard]] Vec3 acceleration(const Vec3& arm) const {
    const Vec3 around = twist.spin.cross(arm);
    return twist.spin.cross(is_held ? Vec3(around + twist.velocity) : around);
  }
};

}  // namespace

void TurnAhead::prepare(const World& world, const PartBalance& balance) {
  world_ = &world;
  balance_ = &balance;
  turning_.clear();
  for (std::size_t k = 0; k < balance.parts().size(); ++k) {
    const ConnectedPart& part = balance.parts()[k];
    if (!part.is_held || RigidMotions(world, part, world.rest_state()).count() > 0) turning_.push_back(k);
  }
}

bool TurnAhead::lay(const Way& way, ConstReals given, State& at, std::vector<double>& ahead,
                    std::vector<double>& v, Reals rigid_velocities) const {
  bool found = false;
  const State& start = way.start;
  const State& base = way.base;
  const Past& past = way.past;
  const double move = way.move;
  const double seconds = way.end - start.time;
  const double share = (base.time - start.time) / seconds;
  const std::vector<std::uint8_t>& masks = world_->fixed().masks();
  for (const std::size_t k : turning_) {
    const ConnectedPart& part = balance_->parts()[k];
    const RigidMotions rigid(*world_, part, start);
    if (rigid.count() == 0) continue;
    const Carried by = carried(*world_, part, given);
    if (!(seconds * by.spread <= kTogether * world_->extent())) continue;
    const RigidMotions::Twist twist = rigid.twist(start.velocities, by.velocity);
    const double angle = seconds * twist.spin.norm();
    if (!(angle >= kLeast && angle <= kFarthest)) continue;
    if (!found) {
      at = base;
      std::ranges::fill(ahead, 0.0);
      std::ranges::fill(rigid_velocities, 0.0);
    }
    found = true;
    const Turning turning{twist, by.velocity, part.is_held};
    const Advance on = turning.after(seconds);
    const Advance back = turning.after(-past.since);
    // The guess goes on as the part deforms.
    const auto guess = [&](std::int32_t row, const Vec3& rest) {
      const std::uint8_t mask = masks[static_cast<std::size_t>(row)];
      const Vec3 to = block(ConstReals(ahead), row) + share * seconds / move * rest;
      for (int axis = 0; axis < 3; ++axis) {
        if (((mask >> axis) & 1) == 0) block(Reals(v), row)[axis] = to[axis];
      }
    };
    for (const std::int32_t node : part.nodes) {
      const Vec3 from = block(ConstReals(start.positions), node);
      const Vec3 arm = from - rigid.center();
      const Vec3 to = from + share * on.move(arm);
      block(Reals(at.positions), node) = to;
      block(Reals(ahead), node) = (to - block(ConstReals(base.positions), node)) / move;
      if (!rigid_velocities.empty()) {
        block(rigid_velocities, node) =
            (share * on.move(arm) - past.velocity * turning.velocity(arm) -
             past.acceleration * turning.acceleration(arm) + past.way * back.move(arm)) /
            move;
      }
      guess(node, block(ConstReals(start.velocities), node) - turning.velocity(arm));
    }
    for (const std::int32_t number : part.frames) {
      const std::int32_t row = world_->frames()[static_cast<std::size_t>(number)].rotation;
      const auto frame = static_cast<std::size_t>(number);
      at.rotations[frame] = (turn_by(share * seconds * twist.spin) * start.rotations[frame]).normalized();
      const Quaternion turn = at.rotations[frame] * base.rotations[frame].conjugate();
      block(Reals(ahead), row) = nearest_turn(turn, Vec3::Zero()) / move;
      if (!rigid_velocities.empty()) block(rigid_velocities, row) = twist.spin;
      guess(row, block(ConstReals(start.velocities), row) - twist.spin);
    }
  }
  return found;
}

}  // namespace tissu
