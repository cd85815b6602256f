#include "tissu/force/rest_shape.h"

#include <Eigen/LU>
#include <algorithm>

namespace tissu {
namespace {

constexpr std::size_t kLanes = ElementOrder::kLanes;
constexpr std::size_t kRest = 10;
constexpr double kFlat =
    1e-14;  ///< of the cube of the largest entry of J: a determinant below it is round-off

/// J at a point: sum_a X_a (x) dN_a/dxi
Mat3 jacobian(const ReferenceCell::Point& point, std::span<const std::int32_t> cell, ConstReals X) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < cell.size(); ++a) {
    J += block(X, cell[a]) * Eigen::Map<const Eigen::RowVector3d>(point.gradients[a].data());
  }
  return J;
}

/// Writes J^-1 and the weight of one point of one lane; the weight, negative or zero when the cell is bad
/// there.
double lay_point(const ReferenceCell::Point& point, std::span<const std::int32_t> cell, ConstReals X,
                 bool real, double* to) {
  const Mat3 J = jacobian(point, cell, X);
  const double det = J.determinant();
  const double scale = J.cwiseAbs().maxCoeff();
  const bool flat = !(det > kFlat * scale * scale * scale);
  const Mat3 inverse = flat ? Mat3(Mat3::Identity()) : Mat3(J.inverse());
  for (int k = 0; k < 9; ++k) to[static_cast<std::size_t>(k) * kLanes] = inverse(k / 3, k % 3);
  to[9 * kLanes] = real ? point.weight * det : 0.0;
  return flat ? 0.0 : point.weight * det;
}

}  // namespace

RestShape rest_shape(const ReferenceCell& reference, const std::vector<std::int32_t>& cells,
                     const ElementOrder& order, ConstReals X) {
  const auto nodes = static_cast<std::size_t>(reference.nodes);
  const std::size_t points = reference.points.size();
  const auto groups = static_cast<std::size_t>(order.groups());
  RestShape shape;
  shape.nodes.resize(groups * nodes * kLanes);
  shape.rest.resize(groups * points * kRest * kLanes);
  shape.volumes.assign(cells.size() / nodes, 0.0);
  for (std::size_t i = 0; i < order.element.size(); ++i) {
    const std::size_t group = i / kLanes;
    const std::size_t lane = i % kLanes;
    const auto e = static_cast<std::size_t>(order.element[i]);
    const bool real = order.real[i] != 0;
    const std::span<const std::int32_t> cell(cells.data() + e * nodes, nodes);
    for (std::size_t a = 0; a < nodes; ++a) shape.nodes[(group * nodes + a) * kLanes + lane] = cell[a];
    bool bad = false;
    for (std::size_t g = 0; g < points; ++g) {
      double* to = shape.rest.data() + (group * points + g) * kRest * kLanes + lane;
      const double w = lay_point(reference.points[g], cell, X, real, to);
      bad = bad || w == 0.0;
      if (real) shape.volumes[e] += w;
    }
    if (bad && real) shape.bad.push_back(static_cast<std::int32_t>(e));
  }
  std::ranges::sort(shape.bad);
  return shape;
}

}  // namespace tissu
