#pragma once

/// A shell element seen from its own axes, which follow its nodes.
///
/// With F = sum_a x_a (x) g_a (3 x 2) the axes R = (r_1, r_2, n) make R^T F = (U; 0), U symmetric. When nodes
/// move by v_a, in the axes of the element, these turn by omega = sum_a G_a v_a:
///   G_a = ((0, 0, h_a2), (0, 0, -h_a1), (-g_a2, g_a1, 0) / tr U),  h_a = U^-1 g_a
/// and what is left of the motion is du_a = v_a - omega x x_a, dphi_a = H(theta_a) (psi_a - omega),
/// where elasticity feels phi_a of theta_a (felt_rotation.h).

#include "tissu/model/shell/shell_element.h"

namespace tissu {

using Mat2 = Eigen::Matrix2d;
using Nodal = std::array<Vec3, 3>;  ///< a vector of each node

struct ShellMotion {
  /// Of det U, 1 at rest: where a triangle is squeezed so flat that a touch would turn it by far, omega is
  /// kept from growing beyond all bounds, and is no longer exact.
  static constexpr double kLeast = 1e-4;

  Mat3 R;
  Mat2 U;
  double trace;           ///< of U
  Triangle2 h;            ///< gradients in the triangle as it is now [1/m]
  Nodal x;                ///< R^T (x_a - centroid)
  Nodal theta;            ///< [rad]
  std::array<Mat3, 3> H;  ///< of phi
  std::array<Mat3, 3> G;  ///< [1/m]
  Vec18 d;                ///< u and phi

  ShellMotion(const ShellElement& element, const ShellPose& pose);

  /// sum_a G_a v_a of a change p, in the axes of the element
  [[nodiscard]] Vec3 spin(const Vec18& p) const;

 private:
  void find_spin(const ShellElement& element);
};

/// -f in the axes of the element, and what it is made of: q = (n_a, H^T m_a) with K d = (n_a, m_a), their
/// moment c = sum_a x_a x n_a + H^T m_a, which is zero at rest, and
///   g_x = n_a - G_a^T c,  g_theta = H^T m_a.
struct ShellGradient {
  Vec18 q;
  Vec3 moment;
  Vec18 g;

  ShellGradient(const ShellMotion& motion, const Vec18& stressed);
};

/// The nodes' vector `k` (2 a: of translation, 2 a + 1: of rotation) of 18 numbers.
inline auto part(Vec18& values, int k) { return values.segment<3>(3 * k); }
inline auto part(const Vec18& values, int k) { return values.segment<3>(3 * k); }

/// Every vector turned by R.
Vec18 turned(const Mat3& R, const Vec18& values);

}  // namespace tissu
