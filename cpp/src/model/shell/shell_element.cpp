#include "tissu/model/shell/shell_element.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "shell_motion.h"
#include "shell_parts.h"
#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

using Vec9 = Eigen::Matrix<double, 9, 1>;

constexpr int kMembrane[9] = {0, 1, 5, 6, 7, 11, 12, 13, 17};
constexpr int kBending[9] = {2, 3, 4, 8, 9, 10, 14, 15, 16};

void check(const ShellSection& section) {
  const auto refuse = [](const std::string& what, double found, const std::string& taken) {
    throw ParameterError("a shell has a " + what + " of " + number_text(found) + "; it must be " + taken +
                         ".");
  };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(section.thickness)) refuse("thickness", section.thickness, "positive and finite");
  if (!positive(section.young)) refuse("Young's modulus", section.young, "positive and finite");
  if (!positive(section.drilling)) refuse("share of drilling", section.drilling, "positive and finite");
  if (!(section.poisson > -1.0 && section.poisson <= 0.5)) {
    refuse("Poisson's ratio", section.poisson, "above -1 and at most 0.5");
  }
}

/// The plane of a triangle: its first side, across it, and its normal.
Mat3 plane_axes(const std::array<Vec3, 3>& X, double& area) {
  constexpr double kFlat = 1e-14;  ///< of the squared size, as rest_shape.cpp has it
  const Vec3 first = X[1] - X[0];
  const Vec3 second = X[2] - X[0];
  const Vec3 normal = first.cross(second);
  area = 0.5 * normal.norm();
  const double size2 = std::max(first.squaredNorm(), second.squaredNorm());
  if (!(area > kFlat * size2)) {
    throw MeshError("a shell's triangle with sides of " + number_text(first.norm()) + " m and " +
                    number_text(second.norm()) + " m has an area of " + number_text(area) +
                    " m2; repair or remove it.");
  }
  Mat3 axes;
  axes.col(0) = first.normalized();
  axes.col(2) = normal.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Triangle2 gradients_of(const Triangle2& nodes, double area) {
  Triangle2 g;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const Eigen::Vector2d edge = nodes.col((a + 2) % 3) - nodes.col((a + 1) % 3);
    g.col(a) = Eigen::Vector2d(-edge[1], edge[0]) / (2.0 * area);
  }
  return g;
}

double von_mises_in_plane(const Vec3& s) {
  return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3.0 * s[2] * s[2]);
}

}  // namespace

ShellElement::ShellElement(const std::array<Vec3, 3>& rest_positions, const ShellSection& section)
    : section_(section), area_(0.0), axes_(plane_axes(rest_positions, area_)) {
  check(section);
  const Vec3 centroid = (rest_positions[0] + rest_positions[1] + rest_positions[2]) / 3.0;
  for (Eigen::Index a = 0; a < 3; ++a) {
    nodes_.col(a) =
        axes_.leftCols<2>().transpose() * (rest_positions[static_cast<std::size_t>(a)] - centroid);
  }
  gradients_ = gradients_of(nodes_, area_);
  const FlatTriangle triangle{nodes_, gradients_, area_};
  membrane_ = section_.share * membrane_stiffness(triangle, section_);
  bending_ = section_.share * bending_stiffness(triangle, section_);
}

double ShellElement::nodal_inertia(double density) const {
  const double t = section_.thickness;
  return nodal_mass(density) * std::max(t * t / 12.0, area_ / 8.0);
}

Vec18 ShellElement::stressed(const Vec18& d) const {
  Vec18 f;
  f(kMembrane) = membrane_.lazyProduct(Vec9(d(kMembrane)));
  f(kBending) = bending_.lazyProduct(Vec9(d(kBending)));
  return f;
}

Mat18 ShellElement::whole() const {
  Mat18 K = Mat18::Zero();
  K(kMembrane, kMembrane) = membrane_;
  K(kBending, kBending) = bending_;
  return K;
}

double ShellElement::energy(const ShellPose& pose) const {
  const ShellMotion motion(*this, pose);
  return 0.5 * motion.d.dot(stressed(motion.d));
}

Vec18 ShellElement::force(const ShellPose& pose) const {
  const ShellMotion motion(*this, pose);
  return turned(-motion.R, ShellGradient(motion, stressed(motion.d)).g);
}

ShellStress ShellElement::stress(const ShellPose& pose) const {
  const ShellMotion motion(*this, pose);
  const FlatTriangle triangle{nodes_, gradients_, area_};
  const Mat3 C = plane_stress(section_);
  const Vec3 middle = C * (mean_strain(triangle) * motion.d(kMembrane));
  const Vec3 bent =
      0.5 * section_.thickness * (C * (curvature(triangle, Vec3::Constant(1.0 / 3.0)) * motion.d(kBending)));
  return {von_mises_in_plane(middle + bent), von_mises_in_plane(middle), von_mises_in_plane(middle - bent)};
}

double ShellElement::volume_ratio(const ShellPose& pose) const {
  const ShellMotion motion(*this, pose);
  const double thinner = section_.poisson / (1.0 - section_.poisson) * (motion.U.trace() - 2.0);
  return motion.U.determinant() * (1.0 - thinner);
}

}  // namespace tissu
