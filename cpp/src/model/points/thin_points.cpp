#include "tissu/model/points/thin_points.h"

#include <Eigen/Geometry>
#include <limits>

namespace tissu {
namespace {

constexpr double kGone = 1e-6;  ///< a stretch below it leaves no material

}  // namespace

ThinPoints::ThinPoints(const ElasticBlock& block, int of)
    : m(of), small_strain(!law_info(block, laws_of(block).front()).frame_invariant), plane(block.plane) {}

Mat3 ThinPoints::unstrained_across(const CellPoint& at) const {
  Mat3 F = at.Q.transpose() * at.dx;
  if (small_strain) {
    for (int j = m; j < 3; ++j) {
      for (int k = 0; k < m; ++k) F(k, j) = -F(j, k);
      F(j, j) = 1.0;
    }
  } else if (m == 2) {
    F.col(2) = F.col(0).cross(F.col(1)).normalized();
    if (plane != Plane::free && F(2, 2) < 0.0) F.col(2) = -F.col(2);
  } else {
    const Mat3 R = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), F.col(0)).toRotationMatrix();
    F.rightCols<2>() = R.rightCols<2>();
  }
  return F;
}

Mat3 ThinPoints::stretched(Mat3 F, const Mat3& free) const {
  for (int j = m; j < 3; ++j) {
    if (small_strain) {
      F(j, j) = free(j, j);
    } else if (free.col(j).norm() > kGone) {
      F.col(j) = free.col(j);
    } else {
      F.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return F;
}

}  // namespace tissu
