#pragma once

/// What no torque may be: above the motors' limits, above the force at the tip, faster than the slew.

#include "tissu/haptic/kinematics.h"

namespace tissu::haptic {

struct TorqueLimits {
  Joints torque{6.0, 6.0, 0.2, 5.0};  ///< of each axis [N m, N m, N m, N]; Chendeb 2007, table 5.4.5
  double force = 5.0;                 ///< at the tip [N]
  double slew = 0.2;                  ///< of `torque` in one tick
  double speed = 2.0;                 ///< of the tip [m/s]; faster is held for a fault of the encoders
};

/// tau times one factor, at most 1, so that no axis and not the tip is above its limit: the direction is
/// kept.
Joints saturated(const TorqueLimits& limits, const Joints& q, const Joints& tau) noexcept;
/// From `before` towards tau by one factor, so that no axis moves by more than slew times its limit.
Joints slewed(const TorqueLimits& limits, const Joints& before, const Joints& tau) noexcept;
/// The tip's speed [m/s] from dq in one period, less two counts of each joint, which may be round-off of the
/// encoder.
double least_tip_speed(const Kinematics& kinematics, const Joints& q, const Joints& dq,
                       const Joints& count_size, double period) noexcept;

}  // namespace tissu::haptic
