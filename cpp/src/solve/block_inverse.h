#pragma once

#include <Eigen/LU>

#include "tissu/base/vec.h"

namespace tissu {

inline bool is_definite(const Mat3& D) {
  return D(0, 0) > 0.0 && D.topLeftCorner<2, 2>().determinant() > 0.0 && D.determinant() > 0.0;
}

/// The inverse of the block's diagonal, made positive; zero where it is zero.
inline Mat3 diagonal_inverse(const Mat3& D) {
  const Vec3 d = D.diagonal().cwiseAbs();
  return (d.array() > 0.0).select(d.cwiseInverse(), Vec3::Zero()).asDiagonal();
}

/// The inverse of a block. One that is not positive definite would turn a preconditioner; its diagonal, made
/// positive, will not.
inline Mat3 positive_inverse(const Mat3& D) {
  return is_definite(D) ? Mat3(D.inverse()) : diagonal_inverse(D);
}

/// z = B r for rows [begin, end), a block for each row, column by column.
template <class T>
void multiply_blocks(const T* blocks, std::int32_t begin, std::int32_t end, const T* r, T* z) {
  for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
    const T* m = blocks + 9 * i;
    const T* in = r + 3 * i;
    for (std::size_t k = 0; k < 3; ++k) z[3 * i + k] = m[k] * in[0] + m[3 + k] * in[1] + m[6 + k] * in[2];
  }
}

}  // namespace tissu
