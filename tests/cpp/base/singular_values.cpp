#include "singular_values.h"

#include <Eigen/SVD>

namespace tissu::test {

SingularValues singular_values(const Mat3& F) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace tissu::test
