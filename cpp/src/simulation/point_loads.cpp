#include "point_loads.h"

namespace tissu {

PointLoads::PointLoads(std::span<const CarriedPoint> points, const std::vector<std::uint8_t>& given)
    : columns_(3 * static_cast<Eigen::Index>(points.size())) {
  Eigen::Index column = 0;
  for (const CarriedPoint& point : points) {
    for (int k = 0; k < 3; ++k, ++column) {
      for (const CarriedPart& part : point.parts) {
        Vec3 load = part.load(point.axes.row(k).transpose());
        for (int axis = 0; axis < 3; ++axis) {
          if (((given[static_cast<std::size_t>(part.row)] >> axis) & 1) != 0) load[axis] = 0.0;
        }
        if (!load.isZero(0.0)) entries_.push_back({part.row, column, load});
      }
    }
  }
}

Eigen::MatrixXd PointLoads::right(std::int32_t rows) const {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(rows), columns_);
  for (const Entry& e : entries_) B.col(e.column).segment<3>(3 * static_cast<Eigen::Index>(e.row)) += e.load;
  return B;
}

Eigen::MatrixXd PointLoads::motions(const Eigen::MatrixXd& X) const {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(columns_, X.cols());
  for (const Entry& e : entries_) {
    W.row(e.column) += e.load.transpose() * X.middleRows<3>(3 * static_cast<Eigen::Index>(e.row));
  }
  return W;
}

}  // namespace tissu
