/// The derivative of a shell element's force, from -f = R g (shell_motion.h):
///   d(R g) = R (dg + omega x g),  g = P^T q,  P = I - S G,  S = (-[x_a]; I)
/// where S omega is the rigid motion by omega. The change of q is M P p, M = H^T K H + L with L of H^T while
/// m is kept. The change of P^T while q is kept is that of x_a and of U:
///   Z_ab = G_a^T [n_b] + ((G_a^T c) (x) g_b / tr U in the plane, (h_b . k) h_a across it), k = (-c_2, c_1).
/// Altogether, Gamma = ([g_x]; [g_theta]),
///   P^T M P + Z P - Gamma G,
/// and its symmetric part has 1/2 [g_theta] more in the blocks of a node's rotation with itself.

#include "felt_rotation.h"
#include "shell_motion.h"

namespace tissu {
namespace {

using Mat183 = Eigen::Matrix<double, 18, 3>;

constexpr int translation(int a) { return 6 * a; }
constexpr int rotation(int a) { return 6 * a + 3; }

Mat183 rigid_spin(const ShellMotion& motion) {
  Mat183 S;
  for (int a = 0; a < 3; ++a) {
    S.middleRows<3>(translation(a)) = -skew(motion.x[static_cast<std::size_t>(a)]);
    S.middleRows<3>(rotation(a)).setIdentity();
  }
  return S;
}

/// H^T K H in place
void turn_rotations(const ShellMotion& motion, Mat18& K) {
  for (int a = 0; a < 3; ++a) {
    const Mat3& H = motion.H[static_cast<std::size_t>(a)];
    K.middleCols<3>(rotation(a)) *= H;
    K.middleRows<3>(rotation(a)).applyOnTheLeft(H.transpose());
  }
}

/// A - B G
void subtract(const ShellMotion& motion, const Mat183& B, Mat18& A) {
  for (int a = 0; a < 3; ++a) {
    A.middleCols<3>(translation(a)) -= B.lazyProduct(motion.G[static_cast<std::size_t>(a)]);
  }
}

/// P^T M P in place
void project(const ShellMotion& motion, const Mat183& S, Mat18& M) {
  const Mat183 MS = M.lazyProduct(S);
  subtract(motion, MS, M);
  const Eigen::Matrix<double, 3, 18> SM = S.transpose().lazyProduct(M);
  for (int a = 0; a < 3; ++a) {
    M.middleRows<3>(translation(a)) -= motion.G[static_cast<std::size_t>(a)].transpose().lazyProduct(SM);
  }
}

/// Z_ab: the change of -G_a^T c with du_b
Mat3 axes_change(const ShellElement& element, const ShellMotion& motion, const ShellGradient& gradient, int a,
                 int b) {
  const Mat3& G = motion.G[static_cast<std::size_t>(a)];
  const Vec3 pull = G.transpose() * gradient.moment;
  const Eigen::Vector2d k(-gradient.moment[1], gradient.moment[0]);
  Mat3 Z = G.transpose() * skew(part(gradient.q, 2 * b));
  Z.topLeftCorner<2, 2>() += pull.head<2>() * element.gradients().col(b).transpose() / motion.trace;
  Z.row(2).head<2>() += motion.h.col(b).dot(k) * motion.h.col(a).transpose();
  return Z;
}

/// R A R^T, its symmetric part
Mat18 in_space(const Mat3& R, const Mat18& A) {
  Mat18 K;
  for (int i = 0; i < 18; i += 3) {
    for (int j = 0; j < i; j += 3) {
      const Mat3 even = 0.5 * (A.block<3, 3>(i, j) + A.block<3, 3>(j, i).transpose());
      const Mat3 turned_block = R * even * R.transpose();
      K.block<3, 3>(i, j) = turned_block;
      K.block<3, 3>(j, i) = turned_block.transpose();
    }
    const Mat3 diagonal = R * A.block<3, 3>(i, i) * R.transpose();
    K.block<3, 3>(i, i) = 0.5 * (diagonal + diagonal.transpose());
  }
  return K;
}

}  // namespace

Mat18 ShellElement::material_stiffness(const ShellPose& pose) const {
  const ShellMotion motion(*this, pose);
  Mat18 K = whole();
  turn_rotations(motion, K);
  project(motion, rigid_spin(motion), K);
  return in_space(motion.R, K);
}

Mat18 ShellElement::stiffness(const ShellPose& pose) const {
  const ShellMotion motion(*this, pose);
  const Vec18 pulled = stressed(motion.d);
  const ShellGradient gradient(motion, pulled);
  const Mat183 S = rigid_spin(motion);
  Mat18 K = whole();
  turn_rotations(motion, K);
  for (int a = 0; a < 3; ++a) {
    K.block<3, 3>(rotation(a), rotation(a)) +=
        felt_moment_change(motion.theta[static_cast<std::size_t>(a)], part(pulled, 2 * a + 1));
  }
  project(motion, S, K);
  Mat183 turn;  // Z S + Gamma
  for (int a = 0; a < 3; ++a) {
    Mat3 ZS = Mat3::Zero();
    for (int b = 0; b < 3; ++b) {
      const Mat3 Z = axes_change(*this, motion, gradient, a, b);
      K.block<3, 3>(translation(a), translation(b)) += Z;
      ZS += Z * S.middleRows<3>(translation(b));
    }
    turn.middleRows<3>(translation(a)) = ZS + skew(part(gradient.g, 2 * a));
    turn.middleRows<3>(rotation(a)) = skew(part(gradient.g, 2 * a + 1));
  }
  subtract(motion, turn, K);
  return in_space(motion.R, K);
}

Vec18 ShellElement::product(const ShellPose& pose, const Vec18& p) const {
  const ShellMotion motion(*this, pose);
  const Vec18 pulled = stressed(motion.d);
  const ShellGradient gradient(motion, pulled);
  const Vec18 v = turned(motion.R.transpose(), p);
  const Vec3 omega = motion.spin(v);
  Vec18 left = v;  // P v
  Vec18 changed;   // of d
  for (int a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    part(left, 2 * a) += motion.x[i].cross(omega);
    part(left, 2 * a + 1) -= omega;
    part(changed, 2 * a) = part(left, 2 * a);
    part(changed, 2 * a + 1) = motion.H[i] * part(left, 2 * a + 1);
  }
  const Vec18 dq = stressed(changed);
  Vec18 y = ShellGradient(motion, dq).g;
  Vec3 moment = Vec3::Zero();  // of L
  for (int a = 0; a < 3; ++a) {
    const Vec3 turned_moment =
        felt_moment_change(motion.theta[static_cast<std::size_t>(a)], part(pulled, 2 * a + 1)) *
        part(left, 2 * a + 1);
    moment += turned_moment;
    part(y, 2 * a + 1) += turned_moment;
  }
  for (int a = 0; a < 3; ++a) {
    part(y, 2 * a) -= motion.G[static_cast<std::size_t>(a)].transpose() * moment;
    for (int b = 0; b < 3; ++b)
      part(y, 2 * a) += axes_change(*this, motion, gradient, a, b) * part(left, 2 * b);
    part(y, 2 * a) += omega.cross(Vec3(part(gradient.g, 2 * a)));
    const Vec3 g = part(gradient.g, 2 * a + 1);
    part(y, 2 * a + 1) += omega.cross(g) + 0.5 * g.cross(Vec3(part(v, 2 * a + 1)));
  }
  return turned(motion.R, y);
}

}  // namespace tissu
