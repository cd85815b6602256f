/// Led nodes in a static step: see LedWay.

#include <algorithm>
#include <cmath>

#include "tissu/assembly/fixed_dofs.h"

namespace tissu {
namespace {

/// Angle and displacement of a motion at a share of the way.
struct Given {
  double angle;
  Vec3 displacement;

  Given(const Motion& motion, const LedWay& way, double share)
      : angle(motion.angle(way.time(share))), displacement(motion.displacement(way.time(share))) {
    if (!way.is_from_rest) return;
    angle -= (1.0 - share) * motion.angle(way.from);
    displacement -= (1.0 - share) * motion.displacement(way.from);
  }

  [[nodiscard]] Vec3 place(const Motion& motion, const Vec3& rest) const {
    if (motion.times.empty()) return rest;
    return motion.center + Eigen::AngleAxisd(angle, motion.axis) * (rest - motion.center) + displacement;
  }
  [[nodiscard]] Quaternion turn(const Motion& motion, const Quaternion& rest) const {
    return Quaternion(Eigen::AngleAxisd(angle, motion.axis) * rest);
  }
};

}  // namespace

void FixedDofs::set_way(const LedWay& way, const State& start, double before, double share, const State& now,
                        Reals change) const {
  for (const Led& led : led_) {
    const Motion& motion = motions_[static_cast<std::size_t>(led.motion)];
    const Vec3 off =
        block(ConstReals(start.positions), led.node) - Given(motion, way, 0.0).place(motion, led.rest);
    const Vec3 target = Given(motion, way, share).place(motion, led.rest) + (1.0 - share) * off;
    for (int axis = 0; axis < 3; ++axis) {
      if (((led.mask >> axis) & 1) == 0) continue;
      const auto i = static_cast<std::size_t>(3 * led.node + axis);
      change[i] = target[axis] - now.positions[i];
    }
  }
  for (const LedRotation& led : led_rotations_) {
    const Motion& motion = motions_[static_cast<std::size_t>(led.motion)];
    const auto frame = static_cast<std::size_t>(led.frame);
    const Given first(motion, way, 0.0);
    const Given last(motion, way, share);
    const Quaternion off = start.rotations[frame] * first.turn(motion, led.rest).conjugate();
    const Vec3 left = (1.0 - share) * nearest_turn(off, Vec3::Zero());
    const Quaternion target = turn_by(left) * last.turn(motion, led.rest);
    const Vec3 expected = (last.angle - Given(motion, way, before).angle) * motion.axis;
    block(change, led.block) = nearest_turn(target * now.rotations[frame].conjugate(), expected);
  }
  set_live_way(way, start, before, share, now, change);
}

bool FixedDofs::moves() const {
  return std::ranges::any_of(motions_, [](const Motion& motion) { return !motion.times.empty(); });
}

double FixedDofs::largest_turn(const LedWay& way, const State& start) const {
  double largest = largest_live_turn(way, start);
  for (const Motion& motion : motions_) {
    if (motion.times.empty()) continue;
    double before = Given(motion, way, 0.0).angle;
    double turned = 0.0;
    const auto pass = [&](double share) {
      const double angle = Given(motion, way, share).angle;
      turned += std::abs(angle - before);
      before = angle;
    };
    for (const double time : motion.times) {
      if (time > way.from && time < way.to) pass((time - way.from) / (way.to - way.from));
    }
    pass(1.0);
    largest = std::max(largest, turned);
  }
  return largest;
}

}  // namespace tissu
