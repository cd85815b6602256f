#pragma once

/// A shell element in any pose, and small changes of a pose.

#include "../../base/random.h"
#include "tissu/model/shell/shell_element.h"

namespace tissu::test {

using Corners = std::array<Vec3, 3>;

inline Mat3 turn(const Vec3& theta) {
  const double angle = theta.norm();
  return Eigen::AngleAxisd(angle, angle > 0.0 ? Vec3(theta / angle) : Vec3(Vec3::UnitX())).toRotationMatrix();
}

/// [a], [a] b = a x b
inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 S;
  S << 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0;
  return S;
}

/// Of sides about 1, anywhere in space.
inline Corners any_triangle(Random& random) {
  const Mat3 R = random.rotation().toRotationMatrix();
  const Vec3 shift = random.vector();
  Corners X = {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.4, 0.9, 0.0)};
  for (Vec3& x : X) x = R * (x + random.vector(0.15)) + shift;
  return X;
}

/// X moved rigidly, then every node by itself up to `size`: metres and radians of a triangle of size 1.
inline ShellPose any_pose(const Corners& X, double size, Random& random) {
  const Mat3 R = random.rotation().toRotationMatrix();
  const Vec3 shift = random.vector(3.0);
  ShellPose pose;
  for (std::size_t a = 0; a < 3; ++a) {
    pose.positions[a] = R * X[a] + shift + random.vector(size);
    pose.rotations[a] = turn(random.vector(size)) * R;
  }
  return pose;
}

/// x_a + t p, exp(t p) R_a
inline ShellPose moved(const ShellPose& pose, const Vec18& p, double t) {
  ShellPose to = pose;
  for (int a = 0; a < 3; ++a) {
    to.positions[static_cast<std::size_t>(a)] += t * p.segment<3>(6 * a);
    to.rotations[static_cast<std::size_t>(a)].applyOnTheLeft(turn(t * p.segment<3>(6 * a + 3)));
  }
  return to;
}

inline Vec18 any_change(Random& random) {
  Vec18 p;
  for (double& value : p) value = random.number();
  return p;
}

}  // namespace tissu::test
