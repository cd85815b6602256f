#pragma once

/// A block matrix as a dense one, its couplings included.

#include "tissu/assembly/block_matrix.h"

namespace tissu::test {

inline Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  const Sparsity& pattern = matrix.sparsity();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * matrix.rows(), 3 * matrix.rows());
  for (std::int32_t row = 0; row < matrix.rows(); ++row) {
    for (auto s = pattern.begin_of(row); s < pattern.end_of(row); ++s) {
      result.block<3, 3>(3 * row, 3 * pattern.column[static_cast<std::size_t>(s)]) =
          Eigen::Map<const Mat3>(matrix.values() + 9 * s);
    }
  }
  if (matrix.couplings() != nullptr) {
    matrix.couplings()->for_blocks([&](std::int32_t row, std::int32_t column, const Mat3& value) {
      result.block<3, 3>(3 * row, 3 * column) += value;
    });
  }
  return result;
}

/// max |A - B| / max |B|
inline double relative_difference(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return (A - B).cwiseAbs().maxCoeff() / B.cwiseAbs().maxCoeff();
}

}  // namespace tissu::test
