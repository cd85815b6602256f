#pragma once

/// Why a matrix has no factor, whatever share of its diagonal is added to it.

#include <cstdint>
#include <string>

#include "tissu/assembly/block_matrix.h"
#include "tissu/base/error.h"

namespace tissu {

/// The number of a row on the diagonal is not positive, or not finite.
class SingularMatrix : public Error {
 public:
  SingularMatrix(std::int32_t row, int axis, double diagonal);
  [[nodiscard]] std::int32_t row() const { return row_; }      ///< of blocks
  [[nodiscard]] int axis() const { return axis_; }             ///< 0 to 2
  [[nodiscard]] double diagonal() const { return diagonal_; }  ///< what stands there

 private:
  std::int32_t row_;
  int axis_;
  double diagonal_;
};

/// Throws SingularMatrix for the first row without a positive diagonal, and Error where there is none.
[[noreturn]] void refuse_factor(const BlockMatrix& matrix);

}  // namespace tissu
