#include "shell_motion.h"

#include <Eigen/LU>
#include <algorithm>

#include "felt_rotation.h"

namespace tissu {
namespace {

/// Some unit vector across t, which may be zero.
Vec3 across(const Vec3& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  const Vec3 other = t.cross(Vec3(Vec3::Unit(smallest)));
  const double length = other.norm();
  return length > 0.0 ? Vec3(other / length) : Vec3(Vec3::Unit((smallest + 1) % 3));
}

/// The axes of F = (a, b): n across both and, in their plane, the rotation nearest to F. Where they are a
/// line or a point some axes, without a NaN.
Mat3 axes_of(const Vec3& a, const Vec3& b) {
  constexpr double kLine = 1e-14;  ///< of |a|^2 + |b|^2: a product below it is round-off
  Vec3 normal = a.cross(b);
  const double twice_area = normal.norm();
  const double size = a.squaredNorm() + b.squaredNorm();
  normal = twice_area > kLine * size ? Vec3(normal / twice_area)
                                     : across(a.squaredNorm() > b.squaredNorm() ? a : b);
  Vec3 first = a + b.cross(normal);
  const double length = first.norm();
  first = length * length > kLine * size ? Vec3(first / length) : across(normal);
  Mat3 R;
  R << first, normal.cross(first), normal;
  return R;
}

}  // namespace

ShellMotion::ShellMotion(const ShellElement& element, const ShellPose& pose) {
  const Vec3 centroid = (pose.positions[0] + pose.positions[1] + pose.positions[2]) / 3.0;
  Eigen::Matrix<double, 3, 2> F = Eigen::Matrix<double, 3, 2>::Zero();
  for (Eigen::Index a = 0; a < 3; ++a) {
    F += (pose.positions[static_cast<std::size_t>(a)] - centroid) * element.gradients().col(a).transpose();
  }
  R = axes_of(F.col(0), F.col(1));
  U = R.leftCols<2>().transpose() * F;
  for (int a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    x[i] = R.transpose() * (pose.positions[i] - centroid);
    theta[i] = rotation_vector(R.transpose() * pose.rotations[i] * element.axes());
    const Vec3 felt = felt_rotation(theta[i], H[i]);
    part(d, 2 * a) = x[i];
    part(d, 2 * a).head<2>() -= element.nodes().col(a);
    part(d, 2 * a + 1) = felt;
  }
  find_spin(element);
}

void ShellMotion::find_spin(const ShellElement& element) {
  const Triangle2& g = element.gradients();
  trace = std::max(U.trace(), kLeast);
  Mat2 adjugate;
  adjugate << U(1, 1), -U(0, 1), -U(1, 0), U(0, 0);
  h = adjugate * g / std::max(U.determinant(), kLeast);
  for (Eigen::Index a = 0; a < 3; ++a) {
    G[static_cast<std::size_t>(a)] << 0.0, 0.0, h(1, a), 0.0, 0.0, -h(0, a), -g(1, a) / trace,
        g(0, a) / trace, 0.0;
  }
}

Vec3 ShellMotion::spin(const Vec18& p) const {
  return G[0] * part(p, 0) + G[1] * part(p, 2) + G[2] * part(p, 4);
}

ShellGradient::ShellGradient(const ShellMotion& motion, const Vec18& stressed)
    : q(stressed), moment(Vec3::Zero()), g(stressed) {
  for (int a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    part(q, 2 * a + 1) = motion.H[i].transpose() * part(stressed, 2 * a + 1);
    moment += motion.x[i].cross(Vec3(part(q, 2 * a))) + part(q, 2 * a + 1);
  }
  for (int a = 0; a < 3; ++a) {
    part(g, 2 * a) -= motion.G[static_cast<std::size_t>(a)].transpose() * moment;
    part(g, 2 * a + 1) = part(q, 2 * a + 1);
  }
}

Vec18 turned(const Mat3& R, const Vec18& values) {
  Vec18 result;
  for (int k = 0; k < 6; ++k) part(result, k) = R * part(values, k);
  return result;
}

}  // namespace tissu
