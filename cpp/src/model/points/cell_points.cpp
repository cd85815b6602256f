#include "tissu/model/points/cell_points.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace tissu {
namespace {

/// Some unit vector across t.
Vec3 across(const Vec3& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  return t.cross(Vec3(Vec3::Unit(smallest))).normalized();
}

/// Axes whose first m columns span those of J.
Mat3 axes_of(const Mat3& J, int m) {
  Mat3 Q = Mat3::Identity();
  if (m == 3) return Q;
  Q.col(0) = J.col(0).normalized();
  Q.col(2) = m == 2 ? Vec3(J.col(0).cross(J.col(1)).normalized()) : across(Q.col(0));
  Q.col(1) = Q.col(2).cross(Q.col(0));
  return Q;
}

}  // namespace

PlacedCells::PlacedCells(const ElasticBlock& of, std::string_view quadrature, const PointQuery& query)
    : block(of),
      reference(reference_cell(of.element, quadrature)),
      X(query.rest_positions),
      x(query.state.positions) {}

std::size_t PlacedCells::cells() const {
  return block.cells.size() / static_cast<std::size_t>(reference.nodes);
}

CellPoint cell_point(const ElasticBlock& block, const ReferenceCell& reference, ConstReals X, ConstReals x,
                     std::size_t cell, std::size_t g) {
  const ReferenceCell::Point& at = reference.points[g];
  const auto nodes = static_cast<std::size_t>(reference.nodes);
  const int m = reference.dimension;
  CellPoint result{Vec3::Zero(), 0.0, Mat3::Identity(), Mat3::Zero()};
  Mat3 J = Mat3::Zero();
  Mat3 j = Mat3::Zero();
  for (std::size_t a = 0; a < nodes; ++a) {
    const std::int32_t node = block.cells[cell * nodes + a];
    const Eigen::Map<const Eigen::RowVector3d> gradient(at.gradients[a].data());
    result.position += at.values[a] * tissu::block(X, node);
    J += tissu::block(X, node) * gradient;
    j += tissu::block(x, node) * gradient;
  }
  result.Q = axes_of(J, m);
  Mat3 R = result.Q.transpose() * J;  // its last columns and rows are zero below three dimensions
  for (int k = m; k < 3; ++k) R(k, k) = 1.0;
  const auto number = static_cast<std::int32_t>(cell);
  const double size = m == 3 ? 1.0 : of_cell(block.cross_section, number);
  result.volume = at.weight * std::abs(R.determinant()) * size * of_cell(block.share, number);
  result.dx = j * R.inverse();
  for (int k = m; k < 3; ++k) result.dx.col(k).setZero();
  return result;
}

PointFields PlacedCells::lay() const {
  PointFields points;
  const std::size_t count = reference.points.size();
  points.points_per_cell = static_cast<int>(count);
  points.resize(cells() * count);
  for (std::size_t i = 0; i < points.volumes.size(); ++i) {
    const CellPoint at = point(i / count, i % count);
    Eigen::Map<Vec3>(points.positions.data() + 3 * i) = at.position;
    points.volumes[i] = at.volume;
    points.set_gradient(i, at.dx);
  }
  return points;
}

}  // namespace tissu
