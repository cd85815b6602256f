#pragma once

/// The rotation of a deformation gradient alone, without the cells that it is computed for.

#include <array>
#include <cstddef>

namespace tissu::bench {

struct RotationRow {
  const char* name;
  double operations;  ///< of one rotation; 0: not counted
  bool flat;          ///< one gradient of eight is singular, which takes the way by the eigenvector
  /// `F` and `R`: [group][9][8]
  void (*run)(const double* F, std::size_t groups, double* R);
};

using RotationKernels = std::array<RotationRow, 3>;

/// Adds the rows "rotation/...", of about `count` gradients.
void add_rotation_rows(int count);

}  // namespace tissu::bench
