#pragma once

/// Rotation vectors theta = log R, |theta| <= pi, and how they change when R is turned by a small phi from
/// the left, exp(theta + dtheta) = exp(phi) exp(theta):  dtheta = H(theta) phi,
///   H = I - 1/2 [theta] + eta [theta]^2,  eta = (1 - |theta|/2 cot(|theta|/2)) / |theta|^2
/// (Felippa and Haugen 2005, section 4; [a] b = a x b).

#include <cmath>

#include "tissu/base/vec.h"

namespace tissu {

/// [a]
inline Mat3 skew(const Vec3& a) {
  Mat3 S;
  S << 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0;
  return S;
}

inline Vec3 rotation_vector(const Mat3& R) {
  const Quaternion q(R);
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  const double half = std::atan2(sine, sign * q.w());
  return (sine > 0.0 ? 2.0 * sign * half / sine : 2.0) * q.vec();
}

/// eta and mu = 2 d eta / d|theta|^2. Small angles take sum_n |B_2n| / (2n)! |theta|^(2n - 2), Bernoulli's
/// numbers, whose first term left out is below 1e-18.
struct RotationFactors {
  double eta;
  double mu;

  explicit RotationFactors(double angle2) {
    constexpr double kSeries[] = {1.0 / 12.0,
                                  1.0 / 720.0,
                                  1.0 / 30240.0,
                                  1.0 / 1209600.0,
                                  1.0 / 47900160.0,
                                  691.0 / 1307674368000.0,
                                  1.0 / 74724249600.0,
                                  3617.0 / 10670622842880000.0,
                                  43867.0 / 5109094217170944000.0};
    if (angle2 < 0.5) {
      eta = 0.0;
      mu = 0.0;
      for (int n = 8; n >= 0; --n) {
        eta = eta * angle2 + kSeries[n];
        if (n > 0) mu = mu * angle2 + 2.0 * n * kSeries[n];
      }
      return;
    }
    const double half = 0.5 * std::sqrt(angle2);
    const double sine = std::sin(half);
    const double cotangent = std::cos(half) / sine;
    eta = (1.0 - half * cotangent) / angle2;
    mu = (0.25 / (sine * sine) + 0.25 * cotangent / half - 2.0 / angle2) / angle2;
  }
};

/// H(theta)
inline Mat3 rotation_change(const Vec3& theta) {
  const Mat3 S = skew(theta);
  return Mat3::Identity() - 0.5 * S + RotationFactors(theta.squaredNorm()).eta * S * S;
}

/// d(H(theta)^T m)/dphi with m kept, dtheta = H phi.
inline Mat3 moment_change(const Vec3& theta, const Vec3& m) {
  const RotationFactors factor(theta.squaredNorm());
  const Vec3 twice = theta.cross(theta.cross(m));
  Mat3 L = -0.5 * skew(m) + factor.mu * twice * theta.transpose();
  L += factor.eta * (theta * m.transpose() - 2.0 * m * theta.transpose());
  L.diagonal().array() += factor.eta * theta.dot(m);
  return L * rotation_change(theta);
}

}  // namespace tissu
