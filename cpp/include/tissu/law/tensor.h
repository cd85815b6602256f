#pragma once

/// Second- and fourth-order tensors of one material point. The scalar T is a double or a batch of lanes.

/// Loops over the components of a tensor are written out by the compiler, so that every index is a constant.
#define TISSU_UNROLL _Pragma("GCC unroll 64")

namespace tissu {

/// 3 x M: F and P of a piece of material of M dimensions in space.
template <class T, int M>
struct Columns {
  T m[3][M];
  T& operator()(int i, int j) { return m[i][j]; }
  const T& operator()(int i, int j) const { return m[i][j]; }
};
template <class T>
using Tensor2 = Columns<T, 3>;

/// dP/dF = d2W/dF2: symmetric 3 M x 3 M, row M i + J for F_iJ, upper triangle row after row.
template <class T, int M>
struct ColumnsTangent {
  static constexpr int kRows = 3 * M;
  static constexpr int kSize = kRows * (kRows + 1) / 2;
  T a[kSize];
  static constexpr int index(int row, int column) {
    return row <= column ? row * kRows - row * (row - 1) / 2 + (column - row) : index(column, row);
  }
  T& operator()(int i, int J, int k, int L) { return a[index(M * i + J, M * k + L)]; }
  const T& operator()(int i, int J, int k, int L) const { return a[index(M * i + J, M * k + L)]; }
};
template <class T>
using Tangent = ColumnsTangent<T, 3>;

/// A B
template <class T>
inline Tensor2<T> product(const Tensor2<T>& A, const Tensor2<T>& B) {
  Tensor2<T> C;
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) C(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
  }
  return C;
}

/// A B^T
template <class T>
inline Tensor2<T> product_transposed(const Tensor2<T>& A, const Tensor2<T>& B) {
  Tensor2<T> C;
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) C(i, j) = A(i, 0) * B(j, 0) + A(i, 1) * B(j, 1) + A(i, 2) * B(j, 2);
  }
  return C;
}

/// A^T B
template <class T>
inline Tensor2<T> transposed_product(const Tensor2<T>& A, const Tensor2<T>& B) {
  Tensor2<T> C;
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) C(i, j) = A(0, i) * B(0, j) + A(1, i) * B(1, j) + A(2, i) * B(2, j);
  }
  return C;
}

template <class T>
inline T determinant(const Tensor2<T>& A) {
  return A(0, 0) * (A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1)) -
         A(0, 1) * (A(1, 0) * A(2, 2) - A(1, 2) * A(2, 0)) +
         A(0, 2) * (A(1, 0) * A(2, 1) - A(1, 1) * A(2, 0));
}

}  // namespace tissu
