#pragma once

/// A flat triangle of a thin shell whose three nodes have positions and rotations: linear elastic in axes
/// that turn with it (element-independent corotational formulation: Felippa and Haugen, Comput. Methods Appl.
/// Mech. Eng. 194, 2005).
///
/// Membrane: the optimal triangle with drilling rotations (Felippa, Comput. Methods Appl. Mech. Eng. 192,
/// 2003). Bending: the discrete Kirchhoff triangle (Batoz, Bathe and Ho, Int. J. Numer. Methods Eng. 15,
/// 1980).
///
/// With R the axes of the element now and R_0 those at rest, R_a the rotation of a node since rest,
///   u_a = R^T (x_a - x_centroid) - R_0^T (X_a - X_centroid)      [m]
///   theta_a = log(R^T R_a R_0)                                   [rad]
///   W = 1/2 d^T K d,  d = (u_1, theta_1, u_2, theta_2, u_3, theta_3)      [J]
/// K is constant. R is the rotation of the polar decomposition of the triangle's F in its plane, so that it
/// does not depend on the order of the nodes. Strains are small, rotations of the body are not bounded. Where
/// a node is turned by more than a third of a turn from its element, phi_a of felt_rotation.h takes the place
/// of theta_a, so that W is smooth at half a turn.
///
/// Small changes of a state are dx_a [m] and dtheta_a [rad], R_a + dR_a = exp(dtheta_a) R_a, in the axes of
/// space and in the order of d. Forces are -dW of those, [N] and [N m].

#include <array>

#include "tissu/base/vec.h"

namespace tissu {

using Vec18 = Eigen::Matrix<double, 18, 1>;
using Mat18 = Eigen::Matrix<double, 18, 18>;
using Mat9 = Eigen::Matrix<double, 9, 9>;
using Triangle2 = Eigen::Matrix<double, 2, 3>;  ///< a vector in the plane for each node

/// What a shell is made of.
struct ShellSection {
  double thickness;  ///< [m]
  double young;      ///< [Pa]
  double poisson;
  /// Share of the membrane's stiffness against rotations that differ from the mean motion's. 1: the optimal
  /// triangle. Small, 1e-3: nearly a membrane without drilling, for curved shells whose mesh is coarse,
  /// h^2 > t R, on which that stiffness resists bending.
  double drilling = 1.0;
  /// Of the triangle that is material: K, volume, mass and inertia are multiplied by it
  /// (ElasticBlock::share).
  double share = 1.0;
};

struct ShellPose {
  std::array<Vec3, 3> positions;  ///< [m]
  std::array<Mat3, 3> rotations;  ///< since rest
};

/// Von Mises' stress of the triangle's mean strain and mean curvature [Pa]. `top` is the face on the side of
/// the normal (X_2 - X_1) x (X_3 - X_1).
struct ShellStress {
  double top;
  double middle;
  double bottom;
};

class ShellElement {
 public:
  /// Refuses triangles that are a line or a point, thicknesses and moduli that are not positive, and
  /// Poisson's ratios outside (-1, 1/2].
  ShellElement(const std::array<Vec3, 3>& rest_positions, const ShellSection& section);

  [[nodiscard]] double energy(const ShellPose& pose) const;
  [[nodiscard]] Vec18 force(const ShellPose& pose) const;
  /// -df/d(x, theta), the symmetric part: what it leaves out is -1/2 [m_a] of a node's rotation with itself,
  /// m_a = -f the moment on the node, whose sum over the elements of a node in balance is zero.
  [[nodiscard]] Mat18 stiffness(const ShellPose& pose) const;
  /// The part of it that K makes, without that of the stress: positive semi-definite in every state.
  [[nodiscard]] Mat18 material_stiffness(const ShellPose& pose) const;
  /// stiffness(pose) p, without the matrix.
  [[nodiscard]] Vec18 product(const ShellPose& pose, const Vec18& p) const;

  [[nodiscard]] ShellStress stress(const ShellPose& pose) const;
  /// det F of the volume: that of the surface, and how much thinner it is under plane stress.
  [[nodiscard]] double volume_ratio(const ShellPose& pose) const;

  [[nodiscard]] double area() const { return area_; }  ///< at rest [m2]
  [[nodiscard]] double volume() const {                ///< of the material at rest [m3]
    return area_ * section_.thickness * section_.share;
  }
  [[nodiscard]] double nodal_mass(double density) const { return density * volume() / 3.0; }  ///< [kg]
  /// About every axis alike [kg m2], m max(t^2 / 12, A / 8): as large as keeps rotations from vibrating
  /// faster than translations do (Hughes, Cohen and Haroun, Nucl. Eng. Des. 46, 1978). Its error goes with
  /// the square of the mesh size.
  [[nodiscard]] double nodal_inertia(double density) const;

  [[nodiscard]] const Mat3& axes() const { return axes_; }                 ///< at rest, normal last
  [[nodiscard]] const Triangle2& nodes() const { return nodes_; }          ///< at rest, from the centroid [m]
  [[nodiscard]] const Triangle2& gradients() const { return gradients_; }  ///< of the nodes' functions [1/m]
  [[nodiscard]] const ShellSection& section() const { return section_; }

 private:
  /// K d
  [[nodiscard]] Vec18 stressed(const Vec18& d) const;
  [[nodiscard]] Mat18 whole() const;  ///< K

  ShellSection section_;
  double area_;
  Mat3 axes_;
  Triangle2 nodes_;
  Triangle2 gradients_;
  Mat9 membrane_;  ///< of u_x, u_y, theta_z of each node
  Mat9 bending_;   ///< of u_z, theta_x, theta_y of each node
};

}  // namespace tissu
