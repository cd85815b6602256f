#include "tissu/state/state.h"

#include <Eigen/LU>

namespace tissu {

Mat3 spatial_inertia(const Frame& frame, const Quaternion& rotation) {
  const Mat3 R = rotation.toRotationMatrix();
  return R * frame.inertia * R.transpose();
}

void move(const State& from, const std::vector<Frame>& frames, ConstReals v, double h, State& to) {
  for (std::size_t i = 0; i < from.positions.size(); ++i) to.positions[i] = from.positions[i] + h * v[i];
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::int32_t rotation_block = frames[k].block + 1;
    block(Reals(to.positions), rotation_block).setZero();
    const Vec3 turn = h * block(v, rotation_block);
    const double angle = turn.norm();
    const Vec3 axis = angle > 0.0 ? Vec3(turn / angle) : Vec3::UnitX();
    to.rotations[k] = (Quaternion(Eigen::AngleAxisd(angle, axis)) * from.rotations[k]).normalized();
  }
}

void keep_angular_momentum(const State& from, const std::vector<Frame>& frames, State& to) {
  for (std::size_t k = 0; k < frames.size(); ++k) {
    auto omega = block(Reals(to.velocities), frames[k].block + 1);
    const Vec3 momentum = spatial_inertia(frames[k], from.rotations[k]) * omega;
    omega = spatial_inertia(frames[k], to.rotations[k]).inverse() * momentum;
  }
}

}  // namespace tissu
