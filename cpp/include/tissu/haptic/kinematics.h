#pragma once

/// The mechanism of the active trocar: a pivot O, a ring that rolls, a bow that pitches, a tool that turns
/// and slides.
///
/// q = (a, b, psi, r): pitch, roll, own rotation [rad] and depth [m]. The port's frame has its origin in O
/// and e_Z into the body. With s = (tan b, -tan a, 1) the tool's axis is d = s / |s| and its tip is p = r d.
/// Nothing is singular at a = b = 0, as it is in the polar angles of Chendeb 2007 (5.2-5.6); the mechanism is
/// singular at 90 degrees and at r = 0.

#include <Eigen/Core>

#include "tissu/base/vec.h"

namespace tissu::haptic {

inline constexpr int kJoints = 4;
using Joints = Eigen::Vector4d;  ///< a, b, psi [rad], r [m], or what belongs to them
using Jacobian = Eigen::Matrix<double, 3, 4>;

/// Where the joints may be; stops stand at the ends. The own rotation has no end.
struct JointLimits {
  Joints low{-0.78539816339744831, -0.78539816339744831, -1e300, 0.02};
  Joints high{0.78539816339744831, 0.78539816339744831, 1e300, 0.3};
};

/// What a device's joints do to its tool. Positions in the port's frame [m].
class Kinematics {
 public:
  Kinematics() = default;
  Kinematics(const Kinematics&) = default;
  Kinematics& operator=(const Kinematics&) = default;
  Kinematics(Kinematics&&) = default;
  Kinematics& operator=(Kinematics&&) = default;
  virtual ~Kinematics() = default;

  /// Turns the tool's axes (tip at 0, e_z along the tool) into those of the port.
  [[nodiscard]] virtual Mat3 rotation(const Joints& q) const noexcept = 0;
  /// Where the tool's point l is.
  [[nodiscard]] virtual Vec3 point(const Joints& q, const Vec3& l) const noexcept = 0;
  /// J with v = J q. for the velocity of the tool's point l; torques of a force f there are J^T f.
  [[nodiscard]] virtual Jacobian jacobian(const Joints& q, const Vec3& l) const noexcept = 0;
  [[nodiscard]] virtual JointLimits limits() const noexcept = 0;
};

/// Two crossed axes, own rotation and depth:
///   R = R_Y(b) R_X(a') R_Z(psi), tan a' = tan a cos b;   x = R (l + r e_z)
///   J = [Omega_1 x x, Omega_2 x x, Omega_3 x x, d],  Omega = [A e', e_Y + B e', d],  e' = R_Y(b) e_X,
///   A = cos b (1 + tan^2 a) / D,  B = -tan a sin b / D,  D = 1 + tan^2 a cos^2 b
class TrocarKinematics final : public Kinematics {
 public:
  /// Throws ParameterError where an end of pitch or roll is 90 degrees or more, or low is not below high.
  explicit TrocarKinematics(const JointLimits& limits = {});

  [[nodiscard]] Mat3 rotation(const Joints& q) const noexcept override;
  [[nodiscard]] Vec3 point(const Joints& q, const Vec3& l) const noexcept override;
  [[nodiscard]] Jacobian jacobian(const Joints& q, const Vec3& l) const noexcept override;
  [[nodiscard]] JointLimits limits() const noexcept override { return limits_; }

 private:
  JointLimits limits_;
};

/// The tool's axis d, from the pivot to the tip.
Vec3 tool_axis(const Joints& q) noexcept;
/// Omega: the tool's angular velocity is Omega (a., b., psi.).
Mat3 tool_turns(const Joints& q) noexcept;
/// The joints at which the tool's axes are those of R (3 x 3) and its point l is at x; psi in (-pi, pi].
Joints joints_of(const Mat3& R, const Vec3& x, const Vec3& l) noexcept;
/// J^T f, the torques of a force f [N] on the tool's point l.
Joints torques_of(const Joints& q, const Vec3& l, const Vec3& f) noexcept;
/// The same in closed form for a force on the tool's axis at depth r: nothing turns the tool.
///   tau_a = -(r sec^2 a / n) (f_Y + (tan a / n) d.f),  tau_b = (r sec^2 b / n) (f_X - (tan b / n) d.f),  n =
///   |s|
Joints axis_torques(const Joints& q, const Vec3& f) noexcept;
/// psi plus whole turns, so that it is within half a turn of `before`.
double unwrapped(double psi, double before) noexcept;

/// An arm that measures and pushes a point in three directions, as a trocar without own rotation.
class Fulcrum {
 public:
  /// `least_depth` [m]: nearer to the pivot no force is given. Throws ParameterError where it is not above 0.
  explicit Fulcrum(double least_depth = 0.02);

  /// The joints (a, b, 0, r) of a tip at p (port's frame, p_Z > 0).
  [[nodiscard]] Joints joints(const Vec3& p) const noexcept;
  /// The force f = J^-T tau that the arm has to give for torques on a, b and r [N]; 0 nearer than the least
  /// depth or where p_Z <= 0, where J has no inverse to speak of.
  [[nodiscard]] Vec3 force(const Joints& q, const Joints& tau) const noexcept;

 private:
  double least_depth_;
};

}  // namespace tissu::haptic
