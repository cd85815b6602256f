#pragma once

/// What a torque on a joint asks of its motor: efficiency with its sign, and a share of the friction.
///
///   motor = (tau + share f_c sigma(q.)) / eta^s,   s = +1 where the motor drives the hand (what it asks for
///   times q. is above 0), -1 where the hand drives the motor, blended over |q.| < 2 counts in the longest
///   window of speeds (velocity.h)
///
/// Chendeb 2007 (5.8, 5.9) divides always: while the hand drives, which is most of palpation, the hand then
/// feels tau / eta^2, 2.04 tau for eta = 0.7.

#include "tissu/haptic/kinematics.h"

namespace tissu::haptic {

struct Transmission {
  Joints efficiency = Joints::Ones();  ///< eta of each axis, above 0, at most 1
  Joints coulomb = Joints::Zero();     ///< f_c, as identified [N m, N m, N m, N]
  double share = 0.0;                  ///< of f_c that is compensated, at most 0.8: more is active

  /// Throws ParameterError where a number is outside its bounds.
  void check() const;
  /// share f_c sigma(v): part of `motor`, and of the work that is given out.
  [[nodiscard]] Joints compensation(const Joints& v, const Joints& slow) const noexcept;
  /// The motors' torques for joint torques tau at joint speeds v; `slow`: two counts in the
  /// longest window of speeds.
  [[nodiscard]] Joints motor(const Joints& tau, const Joints& v, const Joints& slow) const noexcept;
};

}  // namespace tissu::haptic
