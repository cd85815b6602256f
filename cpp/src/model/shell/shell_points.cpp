/// A shell at its top, middle and bottom: the strain of the element's mean, eps + z kappa with z = t/2, 0 and
/// -t/2, in axes that turn with it; F = R (I + eps) R_0^T, P = R sigma R_0^T. What lies across is free of
/// stress: eps_nn = -nu / (1 - nu) (eps_xx + eps_yy). Weights through the thickness: Simpson's.

#include <array>

#include "shell_motion.h"
#include "shell_parts.h"
#include "tissu/model/shell/shell.h"

namespace tissu {
namespace {

constexpr std::size_t kFaces = 3;
constexpr std::array<double, kFaces> kHeights = {0.5, 0.0, -0.5};  ///< of the thickness
constexpr std::array<double, kFaces> kShares = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};

const std::array<Eigen::Index, 9> kMembrane = {0, 1, 5, 6, 7, 11, 12, 13, 17};
const std::array<Eigen::Index, 9> kBending = {2, 3, 4, 8, 9, 10, 14, 15, 16};

/// xx, yy and xy of a plane as a tensor; `shear` is what the third is to be divided by.
Mat3 in_plane(const Vec3& values, double shear) {
  Mat3 A = Mat3::Zero();
  A(0, 0) = values[0];
  A(1, 1) = values[1];
  A(0, 1) = A(1, 0) = values[2] / shear;
  return A;
}

}  // namespace

PointFields Shell::point_fields(const PointQuery& query) const {
  PointFields points;
  points.points_per_cell = static_cast<int>(kFaces);
  points.through_thickness = true;
  const auto cells = static_cast<std::size_t>(cell_count());
  points.resize(cells * kFaces);
  points.cell_W.resize(cells);
  for_lanes([&](std::size_t lane, std::size_t cell) {
    const ShellElement& element = elements_[lane];
    const ShellPose now = pose(query.state, cell);
    const ShellMotion motion(element, now);
    const ShellSection& section = element.section();
    const FlatTriangle triangle{element.nodes(), element.gradients(), element.area()};
    const Mat3 C = plane_stress(section);
    const Vec3 middle = mean_strain(triangle) * motion.d(kMembrane);
    const Vec3 bent = curvature(triangle, Vec3::Constant(1.0 / 3.0)) * motion.d(kBending);
    Vec3 centroid = Vec3::Zero();
    for (std::size_t a = 0; a < 3; ++a)
      centroid += tissu::block(query.rest_positions, block_.cells[3 * cell + a]) / 3.0;
    points.cell_W[cell] = element.energy(now) / element.volume();
    for (std::size_t k = 0; k < kFaces; ++k) {
      const std::size_t i = cell * kFaces + k;
      const double z = kHeights[k] * section.thickness;
      const Vec3 eps = middle + z * bent;
      const Vec3 sigma = C * eps;
      Mat3 F = Mat3::Identity() + in_plane(eps, 2.0);
      F(2, 2) -= section.poisson / (1.0 - section.poisson) * (eps[0] + eps[1]);
      points.set_gradient(i, motion.R * F * element.axes().transpose());
      points.set_stress(i, motion.R * in_plane(sigma, 1.0) * element.axes().transpose());
      points.W[i] = 0.5 * sigma.dot(eps);
      points.volumes[i] = kShares[k] * element.volume();
      Eigen::Map<Vec3>(points.positions.data() + 3 * i) = centroid + z * element.axes().col(2);
    }
  });
  return points;
}

}  // namespace tissu
