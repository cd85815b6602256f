#include "stale_cholesky.h"

#include <algorithm>

namespace tissu {

template <class T>
void StaleCholesky<T>::make(const LinearOperator& A, double scale) {
  const BlockMatrix& matrix = *A.matrix();
  if (A.couplings() == nullptr) {
    factor_.make(matrix);
  } else if (!factor_.is_of(matrix) && !factor_.attempt(matrix)) {
    factor_.make(matrix, true);  // the couplings hold it
  }
  inverse_scale_ = 1.0 / scale;
  price_ = making() / (static_cast<double>(A.bytes()) + kVectorBytes * A.rows() + application());
}

template <>
void StaleCholesky<double>::apply(std::span<const double> r, std::span<double> z) {
  factor_.solve(r, z);
}

template <>
void StaleCholesky<float>::apply(std::span<const float> r, std::span<float> z) {
  right_.resize(r.size());
  answer_.resize(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) right_[i] = inverse_scale_ * static_cast<double>(r[i]);
  factor_.solve(right_, answer_);
  for (std::size_t i = 0; i < r.size(); ++i) z[i] = static_cast<float>(answer_[i]);
}

template class StaleCholesky<double>;
template class StaleCholesky<float>;

}  // namespace tissu
