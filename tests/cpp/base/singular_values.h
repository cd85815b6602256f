#pragma once

/// The singular values of 3 x 3 matrices: Eigen's Jacobi rotations, compiled once for all tests.

#include "tissu/base/vec.h"

namespace tissu::test {

/// F = U diag(values) V^T, the values descending and not negative.
struct SingularValues {
  Mat3 U;
  Vec3 values;
  Mat3 V;
};

SingularValues singular_values(const Mat3& F);

}  // namespace tissu::test
