#pragma once

/// The shape of a matrix: what of it decides how its iterations and its factor grow.

#include "tissu/assembly/block_matrix.h"

namespace tissu {

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
  /// Of the diagonal blocks' traces: the 99th percentile over the median.
  double contrast = 1.0;
};

MatrixShape shape_of(const BlockMatrix& A, bool equilibrium);

}  // namespace tissu
