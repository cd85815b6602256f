#include "node_turns.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace tissu {
namespace {

constexpr double kFlat = 1e-6;  ///< smallest over largest singular value of neighbours that span a volume

}  // namespace

Mat3 turn_of(const World& world, const State& state, std::int32_t row) {
  const Sparsity& sparsity = world.sparsity();
  const ConstReals rest(world.shape_positions());
  const ConstReals now(state.positions);
  Mat3 sum = Mat3::Zero();
  for (auto slot = sparsity.begin_of(row); slot < sparsity.end_of(row); ++slot) {
    const std::int32_t other = sparsity.column[static_cast<std::size_t>(slot)];
    sum += (block(now, other) - block(now, row)) * (block(rest, other) - block(rest, row)).transpose();
  }
  const Eigen::JacobiSVD<Mat3> parts(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (parts.info() != Eigen::Success) return Mat3::Identity();  // places that are not finite
  const Vec3& sizes = parts.singularValues();
  if (!(sizes[2] > kFlat * sizes[0])) return Mat3::Identity();
  Mat3 U = parts.matrixU();
  if ((U * parts.matrixV().transpose()).determinant() < 0.0) U.col(2) *= -1.0;
  return U * parts.matrixV().transpose();
}

}  // namespace tissu
