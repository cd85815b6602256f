#pragma once

/// The two linear triangles that a shell is made of, in the plane of the element.

#include "tissu/model/shell/shell_element.h"

namespace tissu {

using Mat39 = Eigen::Matrix<double, 3, 9>;

/// Nodes from the centroid [m], gradients of their linear functions [1/m], area [m2].
struct FlatTriangle {
  Triangle2 nodes;
  Triangle2 gradients;
  double area;
};

/// sigma = C eps of plane stress [Pa], eps = (xx, yy, 2 xy).
Mat3 plane_stress(const ShellSection& section);

/// Mean strain of the freedoms (u_x, u_y, theta_z) of each node.
Mat39 mean_strain(const FlatTriangle& triangle);
/// [N/m], [N], [N m]
Mat9 membrane_stiffness(const FlatTriangle& triangle, const ShellSection& section);

/// Curvature (xx, yy, 2 xy) [1/m] of the freedoms (u_z, theta_x, theta_y) of each node, where the nodes'
/// linear functions are `share`. Its mean is that of the centroid.
Mat39 curvature(const FlatTriangle& triangle, const Vec3& share);
Mat9 bending_stiffness(const FlatTriangle& triangle, const ShellSection& section);

}  // namespace tissu
