#include "diagonal_preconditioner.h"

#include "block_inverse.h"
#include "work.h"

namespace tissu {
namespace {

/// Calls f(row, diagonal block times scale) for every row; `blocks` is scratch where there is no matrix.
template <class Function>
void for_diagonal(const LinearOperator& A, double scale, std::vector<double>& blocks, Function&& f) {
  const BlockMatrix* matrix = A.matrix();
  if (matrix == nullptr) {
    blocks.resize(9 * static_cast<std::size_t>(A.rows()));
    A.diagonal_blocks(blocks);
  }
  A.threads().for_pieces(A.rows(), [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      const Mat3 D = matrix != nullptr
                         ? matrix->diagonal_block(i)
                         : Mat3(Eigen::Map<const Mat3>(blocks.data() + 9 * static_cast<std::ptrdiff_t>(i)));
      f(i, Mat3(scale * D));
    }
  });
  if (matrix == nullptr || A.couplings() == nullptr) return;  // blocks have them already
  const std::vector<std::int32_t>& coupled = A.couplings()->rows();
  for (std::size_t k = 0; k < coupled.size(); ++k) {
    const Mat3& C = A.couplings()->diagonal(static_cast<std::int32_t>(k));
    f(coupled[k], Mat3(scale * (matrix->diagonal_block(coupled[k]) + C)));
  }
}

}  // namespace

template <class T>
void Jacobi<T>::make(const LinearOperator& A, double scale) {
  inverse_.resize(3 * static_cast<std::size_t>(A.rows()));
  price_ = A.diagonal_cost();
  making_ = price_ * static_cast<double>(A.bytes()) + kInverse * static_cast<double>(bytes());
  for_diagonal(A, scale, blocks_, [&](std::int32_t i, const Mat3& D) {
    const Vec3 inverse = diagonal_inverse(D).diagonal();
    for (int k = 0; k < 3; ++k) inverse_[static_cast<std::size_t>(3 * i + k)] = static_cast<T>(inverse[k]);
  });
}

template <class T>
void Jacobi<T>::apply_rows(std::int32_t begin, std::int32_t end, const T* r, T* z) {
  for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
    z[i] = inverse_[i] * r[i];
  }
}

template <class T>
void BlockJacobi<T>::make(const LinearOperator& A, double scale) {
  inverse_.resize(9 * static_cast<std::size_t>(A.rows()));
  price_ = A.diagonal_cost();
  making_ = price_ * static_cast<double>(A.bytes()) + kInverse * static_cast<double>(bytes());
  for_diagonal(A, scale, blocks_, [&](std::int32_t i, const Mat3& D) {
    const Mat3 inverse = positive_inverse(D);
    T* to = inverse_.data() + 9 * static_cast<std::ptrdiff_t>(i);
    for (int k = 0; k < 9; ++k) to[k] = static_cast<T>(inverse.data()[k]);
  });
}

template <class T>
void BlockJacobi<T>::apply_rows(std::int32_t begin, std::int32_t end, const T* r, T* z) {
  multiply_blocks(inverse_.data(), begin, end, r, z);
}

template class Jacobi<double>;
template class Jacobi<float>;
template class BlockJacobi<double>;
template class BlockJacobi<float>;

}  // namespace tissu
