#pragma once

/// What each arm will cost, as far as the matrix shows before any of them was used.

#include "arm.h"
#include "matrix_shape.h"

namespace tissu {

/// Iterations that block-Jacobi takes to lower a residual by `tolerance`: those of the condition number
/// (Saad, Iterative Methods for Sparse Linear Systems, 2nd edition, 6.11.3), which inertia bounds, and
/// without it the bending of the longest direction.
double plain_iterations(const MatrixShape& shape, double tolerance, bool equilibrium);

/// Shares of the solves that have a matrix of other values than the one before, or of another pattern.
struct Changes {
  double values = 1.0;
  double pattern = 0.0;
};

/// `plain`: iterations of block-Jacobi, counted or predicted.
ForArms<Cost> predicted_costs(const MatrixShape& shape, double plain, double tolerance,
                              const Changes& changes, bool equilibrium);

/// Bytes of a factor's numbers.
double factor_bytes(const MatrixShape& shape);

}  // namespace tissu
