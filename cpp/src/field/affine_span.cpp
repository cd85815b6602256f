#include "affine_span.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace tissu {
namespace {

constexpr double kFlat = 1e-6;

}  // namespace

AffineSpan affine_span(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  AffineSpan span{0, Mat3::Identity(), 1.0};
  if (positions.cols() < 2) return span;
  const Vec3 centre = positions.rowwise().mean();
  Mat3 scatter = Mat3::Zero();
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Vec3 d = positions.col(i) - centre;
    scatter += d * d.transpose();
  }
  const double size = scatter.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return span;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(scatter / size);
  span.axes = solver.eigenvectors().rowwise().reverse();  // ascending there, descending here
  const Vec3 squares = solver.eigenvalues().reverse();
  while (span.dimension < 3 && squares[span.dimension] > kFlat * kFlat * squares[0]) ++span.dimension;
  span.flatness = std::sqrt(squares[span.dimension - 1] / squares[0]);
  return span;
}

}  // namespace tissu
