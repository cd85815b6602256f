#pragma once

/// The rotation vector phi that a shell's elasticity feels of a node that is turned by theta = log R from its
/// element: theta itself up to a third of a turn, and along theta beyond, of the size
///   g = a_0 + L u - 2 pi u^3 + pi u^4,  u = (|theta| - a_0) / L,  a_0 = 2 pi / 3,  L = pi - a_0,
/// which falls to zero at half a turn. There theta and -theta are one rotation, so phi has to be odd about
/// it: g and g'' vanish. At a_0 the value and two derivatives are those of theta. So the energy of an element
/// is smooth for all rotations, and so is the work of its forces; theta alone would jump at half a turn.

#include <cmath>
#include <numbers>

#include "rotation_vector.h"

namespace tissu {

/// phi = s theta, dphi = (s I + c theta theta^T) dtheta, and e = dc / d|theta| / |theta|.
struct FeltRotation {
  static constexpr double kFrom = 2.0 * std::numbers::pi / 3.0;

  double s = 1.0;
  double c = 0.0;
  double e = 0.0;

  explicit FeltRotation(const Vec3& theta) {
    const double angle2 = theta.squaredNorm();
    if (angle2 <= kFrom * kFrom) return;
    constexpr double kPi = std::numbers::pi;
    constexpr double kLength = kPi - kFrom;
    const double a = std::sqrt(angle2);
    const double u = (a - kFrom) / kLength;
    const double g = kFrom + kLength * u + kPi * u * u * u * (u - 2.0);
    const double slope = 1.0 + kPi * u * u * (4.0 * u - 6.0) / kLength;
    const double curve = 12.0 * kPi * u * (u - 1.0) / (kLength * kLength);
    s = g / a;
    const double s1 = (slope - s) / a;
    const double s2 = (curve - 2.0 * s1) / a;
    c = s1 / a;
    e = (s2 - c) / angle2;
  }
  [[nodiscard]] bool is_theta() const { return c == 0.0 && s == 1.0; }
};

/// phi of theta, and H of dphi = H psi, where R is turned by a small psi from the left.
inline Vec3 felt_rotation(const Vec3& theta, Mat3& H) {
  H = rotation_change(theta);
  const FeltRotation felt(theta);
  if (felt.is_theta()) return theta;
  H = (felt.s * H + felt.c * theta * (theta.transpose() * H)).eval();
  return felt.s * theta;
}

/// d(H^T m) / dpsi of that H, with m kept.
inline Mat3 felt_moment_change(const Vec3& theta, const Vec3& m) {
  const FeltRotation felt(theta);
  if (felt.is_theta()) return moment_change(theta, m);
  const double along = theta.dot(m);
  const Mat3 H = rotation_change(theta);
  Mat3 change = felt.c * (m * theta.transpose() + theta * m.transpose());
  change += felt.e * along * theta * theta.transpose();
  change.diagonal().array() += felt.c * along;
  return moment_change(theta, felt.s * m + felt.c * along * theta) + H.transpose() * change * H;
}

}  // namespace tissu
