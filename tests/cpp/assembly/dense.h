#pragma once

/// A block matrix as a dense one.

#include "tissu/assembly/block_matrix.h"

namespace tissu::test {

inline Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  const Sparsity& pattern = matrix.sparsity();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * matrix.rows(), 3 * matrix.rows());
  for (std::int32_t row = 0; row < matrix.rows(); ++row) {
    for (auto s = pattern.row_begin[static_cast<std::size_t>(row)];
         s < pattern.row_begin[static_cast<std::size_t>(row) + 1]; ++s) {
      result.block<3, 3>(3 * row, 3 * pattern.column[static_cast<std::size_t>(s)]) =
          Eigen::Map<const Mat3>(matrix.values() + 9 * s);
    }
  }
  for (const ExtraBlock& extra : matrix.extra()) {
    result.block<3, 3>(3 * extra.row, 3 * extra.column) += Eigen::Map<const Mat3>(extra.values.data());
  }
  return result;
}

/// max |A - B| / max |B|
inline double relative_difference(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return (A - B).cwiseAbs().maxCoeff() / B.cwiseAbs().maxCoeff();
}

}  // namespace tissu::test
