#pragma once

/// What each arm will cost, as far as the matrix tells before any of them was used.

#include "arm.h"
#include "tissu/assembly/block_matrix.h"

namespace tissu {

/// What of a matrix decides how its iterations and its factor grow.
struct MatrixShape {
  double rows = 0.0;
  double bytes = 0.0;
  double along = 1.0;    ///< cells in its longest direction, …
  double across = 1.0;   ///< … in the next, …
  double through = 1.0;  ///< … and in the thinnest
  /// Median over the points of what inertia has of the diagonal: a stiffness gives no force where all points
  /// move alike, so that the sum of a row's blocks is its inertia. Zero in equilibrium.
  double inertia = 0.0;
  /// (lambda + 2 mu) / mu, which grows without bound as Poisson's ratio nears 1/2.
  double wave_ratio = 1.0;
};

MatrixShape shape_of(const BlockMatrix& A, bool equilibrium);

/// Iterations that block-Jacobi takes to lower a residual by `tolerance`: those of the condition number
/// (Saad, Iterative Methods for Sparse Linear Systems, 2nd edition, 6.11.3), which inertia bounds, and
/// without it the bending of the longest direction.
double plain_iterations(const MatrixShape& shape, double tolerance);

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
