#pragma once

/// The motion of a rigid tool in the trocar: M(q) q.. + C(q, q.) q. = Q, by the implicit midpoint rule.

#include <Eigen/Core>

#include "tissu/haptic/kinematics.h"

namespace tissu::haptic {

/// Masses and inertias. Those of a real device replace them.
struct ToolInertia {
  double mass = 0.12;                     ///< of the tool [kg]
  double centre = 0.15;                   ///< its centre above the tip [m]
  double across = 1.5e-3;                 ///< about an axis across it, through its centre [kg m^2]
  double axial = 2e-6;                    ///< about its own axis [kg m^2]
  Joints cradle{2e-3, 2e-3, 5e-6, 0.05};  ///< what moves with each joint, rotors reflected [kg m^2, .., kg]
  double held = 0.0;                      ///< of the hand, at the tip [kg]
};

/// Kinetic energy and what comes of it. With t = tan a', c the tool's centre and m_h the hand's mass,
///   T = 1/2 P(r) (a'.^2 + cos^2 a' b.^2) + 1/2 m r.^2 + 1/2 I_axial (psi. - b. sin a')^2 + 1/2 sum cradle
///   q.^2, P = m (r - c)^2 + I_across + m_h r^2,  a'. = A a. + B b.
class Inertia {
 public:
  Inertia(const ToolInertia& tool, const Joints& q) noexcept;

  [[nodiscard]] const Eigen::Matrix4d& matrix() const noexcept { return M_; }
  /// dT/dq at rates v.
  [[nodiscard]] Joints slope(const Joints& v) const noexcept;

 private:
  double A_, B_, sine_, cosine2_;                // A, B; sin a', cos^2 a'
  double Aa_, Ab_, Ba_, Bb_, sine_t_, Da_, Db_;  // slopes; D = 1 + t^2
  double D_, ta_, tb_;                           // dt/da, dt/db
  double P_, Pr_, axial_;
  Eigen::Matrix4d M_;
};

/// Generalised forces at the middle of a step, and how they fall with q and q. (for the iteration only).
struct MotionForces {
  Joints Q = Joints::Zero();
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();  ///< -dQ/dq, about
  Eigen::Matrix4d damping = Eigen::Matrix4d::Zero();    ///< -dQ/dv, about
};

/// Positions and momenta p = M v.
struct ToolState {
  Joints q = Joints::Zero();
  Joints p = Joints::Zero();
};

}  // namespace tissu::haptic
