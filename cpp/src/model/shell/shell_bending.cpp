/// The discrete Kirchhoff triangle (Batoz, Bathe and Ho, Int. J. Numer. Methods Eng. 15, 1980).
///
/// A fibre across the shell tilts by beta = (theta_y, -theta_x). Along side k from node i to node j, of
/// length l and direction s, the deflection w is cubic and s . beta = -dw/ds at both ends and in the middle,
/// while the tilt across the side is linear. So
///   beta = sum_a lambda_a beta_a + sum_k 4 lambda_i lambda_j s_k D_k,
///   D_k = -3/2 (w_j - w_i) / l - 3/4 s_k . (beta_i + beta_j),
/// curvature kappa = sym grad beta is linear, and its energy t^3/12 int 1/2 kappa^T C kappa dA is exact with
/// the midpoints of the sides.

#include "shell_parts.h"

namespace tissu {
namespace {

/// Adds the curvature grad (x) tilt of a tilt that grows with `grad`.
void add_tilt(const Eigen::Vector2d& grad, const Eigen::Vector2d& tilt, double scale, Eigen::Ref<Vec3> to) {
  to += scale * Vec3(grad[0] * tilt[0], grad[1] * tilt[1], grad[0] * tilt[1] + grad[1] * tilt[0]);
}

}  // namespace

Mat39 curvature(const FlatTriangle& triangle, const Vec3& share) {
  Mat39 B = Mat39::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index j = (i + 1) % 3;
    const Eigen::Vector2d gi = triangle.gradients.col(i);
    const Eigen::Vector2d gj = triangle.gradients.col(j);
    add_tilt(gi, -Eigen::Vector2d::UnitY(), 1.0, B.col(3 * i + 1));
    add_tilt(gi, Eigen::Vector2d::UnitX(), 1.0, B.col(3 * i + 2));
    const Eigen::Vector2d edge = triangle.nodes.col(j) - triangle.nodes.col(i);
    const double l = edge.norm();
    const Eigen::Vector2d s = edge / l;
    const Eigen::Vector2d grad = 4.0 * (share[i] * gj + share[j] * gi);
    add_tilt(grad, s, 1.5 / l, B.col(3 * i));
    add_tilt(grad, s, -1.5 / l, B.col(3 * j));
    for (const Eigen::Index a : {i, j}) {
      add_tilt(grad, s, 0.75 * s[1], B.col(3 * a + 1));
      add_tilt(grad, s, -0.75 * s[0], B.col(3 * a + 2));
    }
  }
  return B;
}

Mat9 bending_stiffness(const FlatTriangle& triangle, const ShellSection& section) {
  const double t = section.thickness;
  const Mat3 D = t * t * t / 12.0 * plane_stress(section);
  Mat9 K = Mat9::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    Vec3 midpoint = Vec3::Constant(0.5);
    midpoint[i] = 0.0;
    const Mat39 B = curvature(triangle, midpoint);
    K += triangle.area / 3.0 * (B.transpose() * D * B);
  }
  return 0.5 * (K + K.transpose());
}

}  // namespace tissu
