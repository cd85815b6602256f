#include "tissu/haptic/limits.h"

#include <algorithm>
#include <cmath>

namespace tissu::haptic {

Joints saturated(const TorqueLimits& limits, const Joints& q, const Joints& tau) noexcept {
  double factor = 1.0;
  for (int i = 0; i < kJoints; ++i) {
    const double size = std::abs(tau[i]);
    if (size > limits.torque[i]) factor = std::min(factor, limits.torque[i] / size);
  }
  const double force = Fulcrum().force(q, tau).norm();
  if (force > limits.force) factor = std::min(factor, limits.force / force);
  return factor * tau;
}

Joints slewed(const TorqueLimits& limits, const Joints& before, const Joints& tau) noexcept {
  const Joints change = tau - before;
  double factor = 1.0;
  for (int i = 0; i < kJoints; ++i) {
    const double most = limits.slew * limits.torque[i];
    if (std::abs(change[i]) > most) factor = std::min(factor, most / std::abs(change[i]));
  }
  return factor == 1.0 ? tau : Joints(before + factor * change);
}

double least_tip_speed(const Kinematics& kinematics, const Joints& q, const Joints& dq,
                       const Joints& count_size, double period) noexcept {
  Joints least;
  for (int i = 0; i < kJoints; ++i) {
    least[i] = std::copysign(std::max(0.0, std::abs(dq[i]) - 2.0 * count_size[i]), dq[i]);
  }
  return (kinematics.jacobian(q, Vec3::Zero()) * least).norm() / period;
}

}  // namespace tissu::haptic
