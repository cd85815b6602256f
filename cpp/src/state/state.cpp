#include "tissu/state/state.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "tissu/state/free_turn.h"

namespace tissu {

void copy_rows(std::span<const RowCopy> copies, Reals values) {
  for (const RowCopy copy : copies) block(values, copy.to) = block(ConstReals(values), copy.from);
}

void copy_rows(std::span<const RowCopy> copies, State& state) {
  copy_rows(copies, state.positions);
  copy_rows(copies, state.velocities);
  for (const RowCopy copy : copies) {
    if (copy.to_frame < 0) continue;
    state.rotations[static_cast<std::size_t>(copy.to_frame)] =
        state.rotations[static_cast<std::size_t>(copy.from_frame)];
  }
}

Mat3 spatial_inertia(const Frame& frame, const Quaternion& rotation) {
  const Mat3 R = rotation.toRotationMatrix();
  return R * frame.inertia * R.transpose();
}

Quaternion turn_by(const Vec3& w) {
  const double angle = w.norm();
  const Vec3 axis = angle > 0.0 ? Vec3(w / angle) : Vec3::UnitX();
  return Quaternion(Eigen::AngleAxisd(angle, axis));
}

Vec3 nearest_turn(const Quaternion& q, const Vec3& expected) {
  // |log q| <= pi about an axis a; a itself is unknown of a whole turn, and taken as expected then.
  Vec3 axis = q.vec();
  const double sine = axis.norm();
  axis = sine > 1e-12 ? Vec3(axis / sine) : Vec3(expected.normalized());
  const double angle = 2.0 * std::atan2(sine, q.w());
  const double turns = std::round((expected.dot(axis) - angle) / (2.0 * std::numbers::pi));
  return (angle + 2.0 * std::numbers::pi * turns) * axis;
}

void move(const State& from, const std::vector<Frame>& frames, ConstReals v, double h, State& to) {
  for (std::size_t i = 0; i < from.positions.size(); ++i) to.positions[i] = from.positions[i] + h * v[i];
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::int32_t rotation_block = frames[k].rotation;
    block(Reals(to.positions), rotation_block).setZero();
    const Vec3 omega = block(v, rotation_block);
    if (omega.isZero(0.0)) {
      to.rotations[k] = from.rotations[k];  // to the bit, in however many parts
      continue;
    }
    to.rotations[k] = frames[k].alone ? free_turn(frames[k], from.rotations[k], omega, h)
                                      : (turn_by(h * omega) * from.rotations[k]).normalized();
  }
}

void keep_angular_momentum(const State& from, const std::vector<Frame>& frames, State& to) {
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (frames[k].inertia(0, 0) == 0.0) continue;  // no cell has it, and it is held
    auto omega = block(Reals(to.velocities), frames[k].rotation);
    const Vec3 momentum = spatial_inertia(frames[k], from.rotations[k]) * omega;
    omega = spatial_inertia(frames[k], to.rotations[k]).inverse() * momentum;
  }
}

}  // namespace tissu
