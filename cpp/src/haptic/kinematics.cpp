#include "tissu/haptic/kinematics.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu::haptic {
namespace {

/// R_Y(b) R_X(a'), with its parts: the sine and cosine of a' come from its tangent, which is tan a cos b.
struct Pointing {
  double ta, tb, ca, sa, cb, sb;  ///< tan a, tan b; cos and sin of a' and of b

  explicit Pointing(const Joints& q) noexcept
      : ta(std::tan(q[0])), tb(std::tan(q[1])), cb(std::cos(q[1])), sb(std::sin(q[1])) {
    const double t = ta * cb;
    ca = 1.0 / std::sqrt(1.0 + t * t);
    sa = t * ca;
  }
  [[nodiscard]] Vec3 axis() const noexcept { return {sb * ca, -sa, cb * ca}; }
  [[nodiscard]] Mat3 rotation() const noexcept {
    Mat3 R;
    R << cb, sb * sa, sb * ca, 0.0, ca, -sa, -sb, cb * sa, cb * ca;
    return R;
  }
};

Mat3 rotation_of(const Joints& q) noexcept {
  const double c = std::cos(q[2]);
  const double s = std::sin(q[2]);
  Mat3 turn;
  turn << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return Pointing(q).rotation() * turn;
}

Vec3 point_of(const Joints& q, const Vec3& l) noexcept {
  return rotation_of(q) * Vec3(l[0], l[1], l[2] + q[3]);
}

Jacobian jacobian_of(const Joints& q, const Vec3& l) noexcept {
  const Vec3 x = point_of(q, l);
  const Mat3 omega = tool_turns(q);
  Jacobian J;
  for (int i = 0; i < 3; ++i) J.col(i) = omega.col(i).cross(x);
  J.col(3) = omega.col(2);
  return J;
}

}  // namespace

TrocarKinematics::TrocarKinematics(const JointLimits& limits) : limits_(limits) {
  constexpr double kRight = std::numbers::pi / 2.0;
  for (int i = 0; i < kJoints; ++i) {
    if (!(limits.low[i] < limits.high[i])) {
      throw ParameterError("The low end of a joint must be below its high end; it is " +
                           number_text(limits.low[i]) + " and " + number_text(limits.high[i]) + ".");
    }
  }
  for (const int i : {0, 1}) {
    if (limits.low[i] <= -kRight || limits.high[i] >= kRight) {
      throw ParameterError("Pitch and roll must end before 90 degrees, where the mechanism is singular.");
    }
  }
}

Mat3 TrocarKinematics::rotation(const Joints& q) const noexcept { return rotation_of(q); }

Vec3 TrocarKinematics::point(const Joints& q, const Vec3& l) const noexcept { return point_of(q, l); }

Jacobian TrocarKinematics::jacobian(const Joints& q, const Vec3& l) const noexcept {
  return jacobian_of(q, l);
}

Vec3 tool_axis(const Joints& q) noexcept { return Pointing(q).axis(); }

Mat3 tool_turns(const Joints& q) noexcept {
  const Pointing at(q);
  const double D = 1.0 + at.ta * at.ta * at.cb * at.cb;
  const double A = at.cb * (1.0 + at.ta * at.ta) / D;
  const double B = -at.ta * at.sb / D;
  const Vec3 e(at.cb, 0.0, -at.sb);
  Mat3 omega;
  omega.col(0) = A * e;
  omega.col(1) = Vec3::UnitY() + B * e;
  omega.col(2) = at.axis();
  return omega;
}

Joints joints_of(const Mat3& R, const Vec3& x, const Vec3& l) noexcept {
  const Vec3 d = R.col(2);
  Joints q;
  q << std::atan2(-d[1], d[2]), std::atan2(d[0], d[2]), 0.0, d.dot(x) - l[2];
  const Mat3 turn = Pointing(q).rotation().transpose() * R;
  q[2] = std::atan2(turn(1, 0), turn(0, 0));
  return q;
}

Joints torques_of(const Joints& q, const Vec3& l, const Vec3& f) noexcept {
  return jacobian_of(q, l).transpose() * f;
}

Joints axis_torques(const Joints& q, const Vec3& f) noexcept {
  const Vec3 s(std::tan(q[1]), -std::tan(q[0]), 1.0);
  const double n = s.norm();
  const double along = s.dot(f) / n;
  const double ta = -s[1];
  const double tb = s[0];
  return {-q[3] * (1.0 + ta * ta) / n * (f[1] + ta / n * along),
          q[3] * (1.0 + tb * tb) / n * (f[0] - tb / n * along), 0.0, along};
}

double unwrapped(double psi, double before) noexcept {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return psi - kTurn * std::round((psi - before) / kTurn);
}

Fulcrum::Fulcrum(double least_depth) : least_depth_(least_depth) {
  if (!(least_depth > 0.0)) {
    throw ParameterError("The least depth of a fulcrum must be above 0 m; it is " + number_text(least_depth) +
                         ".");
  }
}

Joints Fulcrum::joints(const Vec3& p) const noexcept {
  return {std::atan2(-p[1], p[2]), std::atan2(p[0], p[2]), 0.0, p.norm()};
}

Vec3 Fulcrum::force(const Joints& q, const Joints& tau) const noexcept {
  constexpr double kRight = std::numbers::pi / 2.0;
  if (!(q[3] >= least_depth_) || std::abs(q[0]) >= kRight || std::abs(q[1]) >= kRight) return Vec3::Zero();
  // f = x d + y e_Y + z e_X solves the closed form of axis_torques() for f.
  const Vec3 s(std::tan(q[1]), -std::tan(q[0]), 1.0);
  const double n = s.norm();
  const double along = tau[3];
  const double fy = -tau[0] * n / (q[3] * (1.0 + s[1] * s[1])) + s[1] / n * along;
  const double fx = tau[1] * n / (q[3] * (1.0 + s[0] * s[0])) + s[0] / n * along;
  return {fx, fy, along * n - s[0] * fx - s[1] * fy};
}

}  // namespace tissu::haptic
