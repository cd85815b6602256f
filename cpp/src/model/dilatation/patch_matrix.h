#pragma once

/// The dense matrix of one patch of cells, put together on the stack.

#include <Eigen/Core>
#include <cstdint>

#include "tissu/cell/cell_patches.h"

namespace tissu {

class PatchMatrix {
 public:
  static constexpr int kMost = 3 * kMostPatchNodes;

  /// Zero, for so many nodes.
  void begin(std::int32_t nodes);
  /// Adds the matrix of a cell of `size` nodes, whose numbers in the patch are `places`, [pair a <= b][9].
  void add_cell(const std::uint8_t* places, int size, const double* blocks);
  /// Adds [node][3] to m and to b.
  void add_vectors(const std::uint8_t* places, int size, const double* m, const double* b);
  /// Adds slope (m b^T + b m^T) + curvature b b^T; only then the matrix is whole and symmetric.
  void close(double slope, double curvature);
  /// Replaces it by the nearest one without negative eigenvalues.
  void make_definite();
  /// blocks of a matrix += scale times its own
  void scatter(const std::int32_t* slots, double scale, double* blocks) const;

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost, kMost>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMost, 1>;

  Matrix K_;  ///< blocks above the diagonal and on it, until it is closed
  Vector m_;
  Vector b_;
};

}  // namespace tissu
