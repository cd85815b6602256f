#include "singular_matrix.h"

#include <cmath>

#include "tissu/base/number_text.h"

namespace tissu {

SingularMatrix::SingularMatrix(std::int32_t row, int axis, double diagonal)
    : Error("the matrix has no factor: the number on its diagonal is " + number_text(diagonal) + " in row " +
            std::to_string(row) + " along " + "xyz"[axis] + ", and numbers above 0 are accepted."),
      row_(row),
      axis_(axis),
      diagonal_(diagonal) {}

void refuse_factor(const BlockMatrix& matrix) {
  for (std::int32_t row = 0; row < matrix.rows(); ++row) {
    const Mat3 D = matrix.diagonal_block(row);
    for (int axis = 0; axis < 3; ++axis) {
      const double value = D(axis, axis);
      if (!(value > 0.0) || !std::isfinite(value)) throw SingularMatrix(row, axis, value);
    }
  }
  throw Error(
      "the matrix of the step has no factor: a number beside its diagonal is not finite or is far "
      "larger than the diagonal; take a smaller dt, or load more slowly.");
}

}  // namespace tissu
