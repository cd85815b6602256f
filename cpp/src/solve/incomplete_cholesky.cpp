#include "incomplete_cholesky.h"

#include <algorithm>
#include <utility>

#include "block_inverse.h"
#include "work.h"

namespace tissu {
namespace {

constexpr double kFirstShift = 1e-3;
constexpr double kLastShift = 1e3;
constexpr double kKept = 0.1;        ///< a larger shift is not tried first at the next matrix
constexpr double kSmallest = 1e-6;   ///< of a pivot, of what it was before the subtraction
constexpr double kPairBytes = 1000;  ///< what a pair of blocks costs, in bytes read from memory

template <class T>
Eigen::Map<Eigen::Matrix<T, 3, 3>> block_of(AlignedVector<T>& values, std::int64_t b) {
  return Eigen::Map<Eigen::Matrix<T, 3, 3>>(values.data() + 9 * b);
}

/// D is safely positive definite, beside the block that it was made from.
bool is_safe(const Mat3& D, const Mat3& from) {
  return is_definite(D) && D.diagonal().minCoeff() > 0.0 &&
         (D.diagonal().array() > kSmallest * from.diagonal().array()).all();
}

}  // namespace

template <class T>
void IncompleteCholesky<T>::make(const LinearOperator& A, double scale) {
  const BlockMatrix& matrix = *A.matrix();
  threads_ = matrix.threads();
  sweep_ = sweep_rows_of<T>(matrix.isa());
  triangle_.update(matrix);
  const auto size = static_cast<std::size_t>(9 * triangle_.blocks() + 1);  // one more can be read
  lower_.resize(size);
  upper_.resize(size);
  inverse_.resize(9 * static_cast<std::size_t>(matrix.rows()));
  failed_.resize(static_cast<std::size_t>(matrix.rows()));
  gather_couplings(matrix);

  int tries = 1;
  while (!factor(matrix, scale)) {
    shift_ = shift_ == 0.0 ? kFirstShift : 10.0 * shift_;
    ++tries;
    if (shift_ > kLastShift) {
      drop_blocks(matrix, scale);
      break;
    }
  }
  scale_rows();
  if (shift_ > kKept) shift_ = 0.0;
  const double vectors = kVectorBytes * matrix.rows();
  const double iteration = static_cast<double>(matrix.bytes()) + vectors +
                           static_cast<double>(2 * triangle_.blocks()) * 9.0 * sizeof(T);
  const double made =
      static_cast<double>(matrix.bytes()) + kPairBytes * static_cast<double>(triangle_.pairs());
  price_ = tries * made / iteration;
  making_ = tries * made;
}

template <class T>
void IncompleteCholesky<T>::gather_couplings(const BlockMatrix& A) {
  shares_.clear();
  if (A.couplings() == nullptr) return;
  A.couplings()->for_blocks([&](std::int32_t row, std::int32_t column, const Mat3& value) {
    if (column >= row) return;
    const auto begin = triangle_.lower_column.begin();
    const auto first = begin + triangle_.lower_begin[static_cast<std::size_t>(row)];
    const auto last = begin + triangle_.lower_begin[static_cast<std::size_t>(row) + 1];
    const auto found = std::lower_bound(first, last, column);
    if (found != last && *found == column) shares_.push_back({found - begin, shares_.size(), value});
  });
  std::ranges::sort(shares_, {}, [](const Share& share) { return std::pair(share.block, share.order); });
}

template <class T>
Mat3 IncompleteCholesky<T>::coupled(std::int64_t b) const {
  Mat3 sum = Mat3::Zero();
  for (auto share = std::ranges::lower_bound(shares_, b, {}, &Share::block);
       share != shares_.end() && share->block == b; ++share) {
    sum += share->value;
  }
  return sum;
}

template <class T>
Mat3 IncompleteCholesky<T>::diagonal(const BlockMatrix& A, std::int32_t i) const {
  const std::int32_t place = A.couplings() == nullptr ? -1 : A.couplings()->place(i);
  return place < 0 ? A.diagonal_block(i) : Mat3(A.diagonal_block(i) + A.couplings()->diagonal(place));
}

template <class T>
bool IncompleteCholesky<T>::factor(const BlockMatrix& A, double scale) {
  std::ranges::fill(failed_, char{0});
  triangle_.forward.for_rows(threads_, [&](const std::int32_t* rows, std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) {
      const bool made = A.couplings() == nullptr ? factor_row<false>(A, scale, rows[i])
                                                 : factor_row<true>(A, scale, rows[i]);
      failed_[static_cast<std::size_t>(rows[i])] = made ? 0 : 1;
    }
  });
  return std::ranges::none_of(failed_, [](char failed) { return failed != 0; });
}

template <class T>
template <bool kCoupled>
bool IncompleteCholesky<T>::factor_row(const BlockMatrix& A, double scale, std::int32_t i) {
  using Block = Eigen::Matrix<T, 3, 3>;
  const auto& column = triangle_.lower_column;
  const auto at = [](std::int64_t n) { return static_cast<std::size_t>(n); };
  const std::int64_t first = triangle_.lower_begin[at(i)];
  const std::int64_t last = triangle_.lower_begin[at(i) + 1];
  Mat3 from = scale * (kCoupled ? diagonal(A, i) : A.diagonal_block(i));
  for (int k = 0; k < 3; ++k) {
    if (!A.is_given(i, k)) from(k, k) += shift_ * std::abs(from(k, k));
  }
  Mat3 D = from;
  for (std::int64_t b = first; b < last; ++b) {
    const std::int32_t j = column[at(b)];
    Mat3 S = scale * Eigen::Map<const Mat3>(triangle_.values(A, b));
    if constexpr (kCoupled) S += scale * coupled(b);
    std::int64_t mine = first;
    std::int64_t other = triangle_.lower_begin[at(j)];
    const std::int64_t end = triangle_.lower_begin[at(j) + 1];
    while (mine < b && other < end) {
      const std::int32_t difference = column[at(mine)] - column[at(other)];
      if (difference == 0) {
        S -= (block_of(upper_, mine) * block_of(lower_, other).transpose()).template cast<double>();
      }
      mine += difference <= 0 ? 1 : 0;
      other += difference >= 0 ? 1 : 0;
    }
    const Block stored = S.template cast<T>();
    const Block weighted =
        stored * Eigen::Map<const Block>(inverse_.data() + 9 * static_cast<std::ptrdiff_t>(j));
    block_of(lower_, b) = stored;
    block_of(upper_, b) = weighted;
    D -= (weighted * stored.transpose()).template cast<double>();
  }
  const bool safe = is_safe(D, from);
  const Mat3 inverse = safe ? Mat3(D.inverse()) : Mat3(Mat3::Zero());
  Eigen::Map<Block>(inverse_.data() + 9 * static_cast<std::ptrdiff_t>(i)) =
      (0.5 * (inverse + inverse.transpose())).template cast<T>();
  return safe;
}

/// No share of the diagonal helps: only the diagonal blocks are kept.
template <class T>
void IncompleteCholesky<T>::drop_blocks(const BlockMatrix& A, double scale) {
  std::ranges::fill(lower_, T(0));
  for (std::int32_t i = 0; i < A.rows(); ++i) {
    Eigen::Map<Eigen::Matrix<T, 3, 3>>(inverse_.data() + 9 * static_cast<std::ptrdiff_t>(i)) =
        positive_inverse(scale * diagonal(A, i)).template cast<T>();
  }
}

/// Both triangles with unit diagonals, so that a sweep is subtractions only.
template <class T>
void IncompleteCholesky<T>::scale_rows() {
  using Block = Eigen::Matrix<T, 3, 3>;
  const auto rows = static_cast<std::int32_t>(failed_.size());
  const auto inverse = [&](std::int32_t i) {
    return Eigen::Map<const Block>(inverse_.data() + 9 * static_cast<std::ptrdiff_t>(i));
  };
  threads_.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      const auto r = static_cast<std::size_t>(i);
      for (auto u = triangle_.upper_begin[r]; u < triangle_.upper_begin[r + 1]; ++u) {
        block_of(upper_, u) =
            inverse(i) * block_of(lower_, triangle_.upper_place[static_cast<std::size_t>(u)]).transpose();
      }
    }
  });
  threads_.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      const auto r = static_cast<std::size_t>(i);
      for (auto b = triangle_.lower_begin[r]; b < triangle_.lower_begin[r + 1]; ++b) {
        block_of(lower_, b) = (inverse(i) * block_of(lower_, b)).eval();
      }
    }
  });
}

template <class T>
void IncompleteCholesky<T>::apply(std::span<const T> r, std::span<T> z) {
  threads_.for_pieces(static_cast<std::int32_t>(r.size() / 3), [&](std::int32_t begin, std::int32_t end) {
    multiply_blocks(inverse_.data(), begin, end, r.data(), z.data());
  });
  triangle_.forward.for_rows(threads_, [&](const std::int32_t* rows, std::int32_t count) {
    sweep_(rows, count, triangle_.lower_begin.data(), triangle_.lower_column.data(), lower_.data(), z.data());
  });
  triangle_.backward.for_rows(threads_, [&](const std::int32_t* rows, std::int32_t count) {
    sweep_(rows, count, triangle_.upper_begin.data(), triangle_.upper_column.data(), upper_.data(), z.data());
  });
}

template <class T>
double IncompleteCholesky<T>::application() const {
  return kSweep * static_cast<double>((lower_.size() + upper_.size() + inverse_.size()) * sizeof(T));
}

template <class T>
std::size_t IncompleteCholesky<T>::bytes() const {
  return (lower_.size() + upper_.size() + inverse_.size()) * sizeof(T) + triangle_.bytes();
}

template class IncompleteCholesky<double>;
template class IncompleteCholesky<float>;

}  // namespace tissu
