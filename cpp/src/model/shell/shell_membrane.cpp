/// Felippa's optimal triangle (Comput. Methods Appl. Mech. Eng. 192, 2003): K = K_b + K_h.
///
/// Basic stiffness: K_b = A t B^T C B with the mean strain B d = (1 / A) L^T d, L what a constant stress
/// lumps to the nodes; its share of moments is alpha = 3/2.
///
/// Higher stiffness: the rotations less that of the mean motion, phi = T d, make the natural strains
/// eps = Q phi along the sides, Q linear between its corner values Q_1, Q_2, Q_3. With Q at the midpoints,
///   K_h = 3/4 beta_0 A t T^T (sum_m Q_m^T C_n Q_m) T.
/// Its nine numbers beta and beta_0 = (1 - 4 nu^2) / 2 make pure bending in the plane exact for every aspect
/// ratio of a rectangle of two triangles.

#include <algorithm>

#include "shell_parts.h"

namespace tissu {
namespace {

constexpr double kAlpha = 1.5;
constexpr double kLeastBeta = 0.01;  ///< of beta_0, zero at nu = 1/2: rotations keep some stiffness
constexpr double kBeta[3][3] = {{1.0, 2.0, 1.0}, {0.0, 1.0, -1.0}, {-1.0, -1.0, -2.0}};

/// From node i to node j.
Eigen::Vector2d side(const FlatTriangle& triangle, Eigen::Index i, Eigen::Index j) {
  return triangle.nodes.col(j) - triangle.nodes.col(i);
}

/// Rotations of the nodes less that of the mean motion, (d u_y/dx - d u_x/dy) / 2.
Mat39 deviation(const FlatTriangle& triangle) {
  Mat39 T = Mat39::Zero();
  for (Eigen::Index a = 0; a < 3; ++a) {
    T.col(3 * a).setConstant(0.5 * triangle.gradients(1, a));
    T.col(3 * a + 1).setConstant(-0.5 * triangle.gradients(0, a));
    T(a, 3 * a + 2) = 1.0;
  }
  return T;
}

/// eps = T_e eps_n: Cartesian strain of the strains along the sides 12, 23, 31. With the side opposite to
/// node k, eps = -sum_k l_ij^2 sym(g_i (x) g_j) eps_ij.
Mat3 of_natural(const FlatTriangle& triangle) {
  Mat3 T;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index j = (i + 1) % 3;
    const auto gi = triangle.gradients.col(i);
    const auto gj = triangle.gradients.col(j);
    T.col(i) = -side(triangle, i, j).squaredNorm() *
               Vec3(gi[0] * gj[0], gi[1] * gj[1], gi[0] * gj[1] + gi[1] * gj[0]);
  }
  return T;
}

/// Q at a corner: rows are the sides 12, 23, 31, columns the nodes.
Mat3 at_corner(const FlatTriangle& triangle, Eigen::Index corner) {
  Mat3 Q;
  for (Eigen::Index s = 0; s < 3; ++s) {
    const double scale = 2.0 * triangle.area / (3.0 * side(triangle, s, (s + 1) % 3).squaredNorm());
    for (Eigen::Index a = 0; a < 3; ++a) Q(s, a) = scale * kBeta[(s + 3 - corner) % 3][(a + 3 - corner) % 3];
  }
  return Q;
}

}  // namespace

Mat3 plane_stress(const ShellSection& section) {
  const double nu = section.poisson;
  Mat3 C;
  C << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  return section.young / (1.0 - nu * nu) * C;
}

Mat39 mean_strain(const FlatTriangle& triangle) {
  Mat39 B;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector2d g = triangle.gradients.col(i);
    const Eigen::Vector2d next = side(triangle, i, (i + 1) % 3);
    const Eigen::Vector2d last = side(triangle, i, (i + 2) % 3);
    B.col(3 * i) = Vec3(g[0], 0.0, g[1]);
    B.col(3 * i + 1) = Vec3(0.0, g[1], g[0]);
    const double shear = (next[0] * next[1] - last[0] * last[1]) / triangle.area;
    B.col(3 * i + 2) = kAlpha / 6.0 * Vec3(-g[0] * (next[1] + last[1]), g[1] * (next[0] + last[0]), shear);
  }
  return B;
}

Mat9 membrane_stiffness(const FlatTriangle& triangle, const ShellSection& section) {
  const Mat3 C = plane_stress(section);
  const double volume = triangle.area * section.thickness;
  const Mat39 B = mean_strain(triangle);
  const Mat3 T_e = of_natural(triangle);
  const Mat3 C_n = T_e.transpose() * C * T_e;
  Mat3 sum = Mat3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Mat3 Q = 0.5 * (at_corner(triangle, i) + at_corner(triangle, (i + 1) % 3));
    sum += Q.transpose() * C_n * Q;
  }
  const double beta =
      section.drilling * std::max(0.5 * (1.0 - 4.0 * section.poisson * section.poisson), kLeastBeta);
  const Mat39 T = deviation(triangle);
  const Mat9 K = volume * (B.transpose() * C * B + 0.75 * beta * (T.transpose() * sum * T));
  return 0.5 * (K + K.transpose());
}

}  // namespace tissu
