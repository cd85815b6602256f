/// P of F itself, in which the patch's common volume ratio theta has its part: with Fbar = s F,
/// s = (rho(theta) / rho(J))^(1/3), Pbar = dW/dF at Fbar, q = Pbar : Fbar / 3 and G = dJ/dF,
///   P = s Pbar - q rho'(J)/rho(J) G + pi G,   pi = rho'(theta)/rho(theta) sum_g w_g q_g / V of the patch,
/// so that f_a = -sum_g w_g P grad_a (kernels/mean_dilatation.h). W is that of Fbar.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tissu/model/dilatation/mean_dilatation.h"
#include "tissu/model/points/cell_points.h"
#include "tissu/model/points/elastic_points.h"
#include "tissu/model/points/listed_material.h"

namespace tissu {
namespace {

/// rho and rho'/rho of kernels/dilated_point.h.
struct Bounded {
  static constexpr double kCollapsed = 0.1;
  double rho;
  double slope;

  explicit Bounded(double J) {
    const double y = std::clamp(J / kCollapsed, 0.0, 1.0);
    const double y3 = y * y * y;
    rho = std::max(J, 0.0) + kCollapsed * (0.5 + y3 - 0.5 * y3 * y - y);
    slope = y * y * (3.0 - 2.0 * y) / rho;
  }
};

/// dJ/dF
Mat3 cofactors(const Mat3& F) {
  Mat3 G;
  for (int j = 0; j < 3; ++j) G.col(j) = F.col((j + 1) % 3).cross(F.col((j + 2) % 3));
  return G;
}

/// Means over the patches, by the volume of their points.
std::vector<double> patch_means(const PointFields& points, const std::vector<std::int32_t>& patch_of_cell,
                                const std::vector<double>& values) {
  const auto count = static_cast<std::size_t>(std::ranges::max(patch_of_cell)) + 1;
  std::vector<double> sums(count, 0.0);
  std::vector<double> volumes(count, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto p =
        static_cast<std::size_t>(patch_of_cell[i / static_cast<std::size_t>(points.points_per_cell)]);
    sums[p] += points.volumes[i] * values[i];
    volumes[p] += points.volumes[i];
  }
  for (std::size_t p = 0; p < count; ++p) sums[p] /= volumes[p];
  return sums;
}

}  // namespace

PointFields MeanDilatation::point_fields(const PointQuery& query) const {
  PointFields points = PlacedCells(block_, block_.quadrature, query).lay();
  const auto count = static_cast<std::size_t>(points.points_per_cell);
  const auto patch = [&](std::size_t i) { return static_cast<std::size_t>(of_cell_[i / count]); };
  std::vector<double> J(points.volumes.size());
  for (std::size_t i = 0; i < J.size(); ++i) J[i] = points.gradient_at(i).determinant();
  const std::vector<double> theta = patch_means(points, of_cell_, J);
  std::vector<double> s(J.size());
  PointFields dilated = points;
  for (std::size_t i = 0; i < J.size(); ++i) {
    s[i] = std::cbrt(Bounded(theta[patch(i)]).rho / Bounded(J[i]).rho);
    dilated.set_gradient(i, s[i] * points.gradient_at(i));
  }
  ListedMaterial(block_, cells_of_points(points), query.isa).stress_and_energy(dilated);
  std::vector<double> q(J.size());
  for (std::size_t i = 0; i < J.size(); ++i)
    q[i] = dilated.stress_at(i).cwiseProduct(dilated.gradient_at(i)).sum() / 3.0;
  const std::vector<double> Q = patch_means(points, of_cell_, q);
  for (std::size_t i = 0; i < J.size(); ++i) {
    const double pi = Bounded(theta[patch(i)]).slope * Q[patch(i)];
    points.set_stress(i, s[i] * dilated.stress_at(i) +
                             (pi - q[i] * Bounded(J[i]).slope) * cofactors(points.gradient_at(i)));
  }
  points.W = dilated.W;
  return points;
}

}  // namespace tissu
