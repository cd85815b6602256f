/// P = R sigma(R^T F), with one R for a cell, of F at its centre: what f_a = -sum_g w_g P grad_a is made of.
/// Cauchy's stress so is P F^T / det F, that of linear elasticity turned by R but for terms of second order.

#include <Eigen/LU>
#include <Eigen/SVD>

#include "tissu/model/corotational/corotational.h"
#include "tissu/model/points/cell_points.h"
#include "tissu/model/points/elastic_points.h"
#include "tissu/model/points/listed_material.h"

namespace tissu {
namespace {

/// The proper rotation nearest to F.
Mat3 polar(const Mat3& F) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  signs[2] = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

/// Axes of the first two columns.
Mat3 axes_of(const Mat3& A) {
  Mat3 Q;
  Q.col(0) = A.col(0).normalized();
  Q.col(1) = (A.col(1) - A.col(1).dot(Q.col(0)) * Q.col(0)).normalized();
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

/// The rotation of a cell: of frame, that of the first two axes of its reference cell at the centre.
Mat3 rotation_of(const PlacedCells& centre, std::size_t cell, Rotation kind) {
  if (kind == Rotation::small) return Mat3::Identity();
  const Mat3 F = centre.point(cell, 0).dx;
  if (kind == Rotation::polar) return polar(F);
  Mat3 J = Mat3::Zero();
  const auto nodes = static_cast<std::size_t>(centre.reference.nodes);
  for (std::size_t a = 0; a < nodes; ++a) {
    J += block(centre.X, centre.block.cells[cell * nodes + a]) *
         Eigen::Map<const Eigen::RowVector3d>(centre.reference.points.front().gradients[a].data());
  }
  return axes_of(F * J) * axes_of(J).transpose();
}

}  // namespace

PointFields Corotational::point_fields(const PointQuery& query) const {
  const PlacedCells centre(block_, "reduced", query);
  PointFields points = PlacedCells(block_, block_.quadrature, query).lay();
  const auto count = static_cast<std::size_t>(points.points_per_cell);
  std::vector<Mat3> R;
  R.reserve(centre.cells());
  for (std::size_t cell = 0; cell < centre.cells(); ++cell) R.push_back(rotation_of(centre, cell, rotation_));
  PointFields turned = points;
  for (std::size_t i = 0; i < points.volumes.size(); ++i) {
    turned.set_gradient(i, R[i / count].transpose() * points.gradient_at(i));
  }
  ListedMaterial(block_, cells_of_points(points), query.isa).stress_and_energy(turned);
  points.W = turned.W;
  for (std::size_t i = 0; i < points.volumes.size(); ++i)
    points.set_stress(i, R[i / count] * turned.stress_at(i));
  return points;
}

}  // namespace tissu
