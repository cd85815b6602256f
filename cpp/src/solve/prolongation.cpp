#include "prolongation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace tissu {
namespace {

using Motion = Eigen::Matrix<double, 3, 6>;  ///< of a row, by a translation and a rotation

constexpr std::int32_t kParts = 16;       ///< in which the rows of A P are made, one after the other
constexpr std::int32_t kLeastRows = 256;  ///< of a part
constexpr double kNoMotion = 1e-9;  ///< of the largest stiffness of an aggregate's translations or rotations

/// Rows made by `row(i, columns)`, which gives columns in any order and more than once.
template <class Row>
RowPattern pattern_of(std::int32_t rows, std::int32_t columns, Row&& row) {
  RowPattern pattern;
  pattern.begin.assign(1, 0);
  std::vector<std::int32_t> seen(static_cast<std::size_t>(columns), -1);
  for (std::int32_t i = 0; i < rows; ++i) {
    row(i, [&](std::int32_t c) {
      if (c < 0 || seen[static_cast<std::size_t>(c)] == i) return;
      seen[static_cast<std::size_t>(c)] = i;
      pattern.column.push_back(c);
    });
    std::sort(pattern.column.begin() + pattern.begin.back(), pattern.column.end());
    pattern.begin.push_back(static_cast<std::int64_t>(pattern.column.size()));
  }
  return pattern;
}

RowPattern transposed(const RowPattern& pattern, std::int32_t columns, std::vector<std::int64_t>& place) {
  RowPattern other;
  other.begin.assign(static_cast<std::size_t>(columns) + 1, 0);
  for (const std::int32_t c : pattern.column) ++other.begin[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 1; c < other.begin.size(); ++c) other.begin[c] += other.begin[c - 1];
  std::vector<std::int64_t> next(other.begin.begin(), other.begin.end() - 1);
  other.column.resize(pattern.column.size());
  place.resize(pattern.column.size());
  for (std::int32_t i = 0; i < pattern.rows(); ++i) {
    for (auto b = pattern.begin[static_cast<std::size_t>(i)];
         b < pattern.begin[static_cast<std::size_t>(i) + 1]; ++b) {
      const auto c = static_cast<std::size_t>(pattern.column[static_cast<std::size_t>(b)]);
      const auto to = static_cast<std::size_t>(next[c]++);
      other.column[to] = i;
      place[to] = b;
    }
  }
  return other;
}

/// How the row moves with its aggregate.
Motion rigid_motion(const LevelMatrix& A, const RowPlaces& fine, const RowPlaces& coarse, std::int32_t row,
                    std::int32_t aggregate) {
  Motion motion = Motion::Zero();
  if (fine.is_rotation(row)) {
    motion.rightCols<3>().setIdentity();
  } else {
    const Vec3 arm =
        block(ConstReals(fine.positions), row) - block(ConstReals(coarse.positions), 2 * aggregate);
    motion.leftCols<3>().setIdentity();
    motion.rightCols<3>() << 0.0, arm[2], -arm[1], -arm[2], 0.0, arm[0], arm[1], -arm[0], 0.0;
  }
  for (int k = 0; k < 3; ++k) {
    if (((A.mask(row) >> k) & 1U) != 0) motion.row(k).setZero();
  }
  return motion;
}

/// Gives motions that cost nothing, as the rotation of a lone point, a stiffness: nothing drives them.
void hold_idle(Eigen::Ref<Mat3> stiffness, double other) {
  const double largest = stiffness.diagonal().maxCoeff();
  if (!(largest > 0.0)) {
    stiffness = Mat3::Identity() * (other > 0.0 ? other : 1.0);
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(stiffness);
  for (int k = 0; k < 3; ++k) {
    if (eigen.eigenvalues()[k] > kNoMotion * largest) continue;
    stiffness += largest * eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose();
  }
}

std::int64_t begin_of(const RowPattern& pattern, std::int32_t row) {
  return pattern.begin[static_cast<std::size_t>(row)];
}
std::int64_t end_of(const RowPattern& pattern, std::int32_t row) {
  return pattern.begin[static_cast<std::size_t>(row) + 1];
}

/// The block of a row in the first column that is not before `least`.
std::int64_t place_of(const RowPattern& pattern, std::int32_t row, std::int32_t least) {
  const auto columns = pattern.row(row);
  return begin_of(pattern, row) + (std::ranges::lower_bound(columns, least) - columns.begin());
}

/// Calls f(b, t) for the blocks b of a row of `from`, from the column `least` on, and the blocks t of the
/// same columns of a row of `to`, which has them all.
template <class Function>
void for_same_columns(const RowPattern& from, std::int32_t row, const RowPattern& to, std::int32_t other,
                      std::int32_t least, Function&& f) {
  std::int64_t t = place_of(to, other, least);
  for (std::int64_t b = place_of(from, row, least); b < end_of(from, row); ++b) {
    while (to.column[static_cast<std::size_t>(t)] != from.column[static_cast<std::size_t>(b)]) ++t;
    f(b, t);
  }
}

Eigen::Map<Motion> motion_at(AlignedVector<double>& values, std::int64_t b) {
  return Eigen::Map<Motion>(values.data() + 18 * b);
}

template <class T>
Eigen::Map<const Eigen::Matrix<T, 3, 6>> motion_at(const BlockRows<T>& P, std::int64_t b) {
  return Eigen::Map<const Eigen::Matrix<T, 3, 6>>(P.block(2 * b));
}

/// Rows [begin, end) of A P, whose first block in `product` is that numbered `first`.
template <class T>
void fill_product(const LevelMatrix& A, const CoarsePattern& pattern, const BlockRows<T>& P,
                  std::int32_t begin, std::int32_t end, std::int64_t first, AlignedVector<double>& product) {
  std::fill(product.begin() + 18 * (begin_of(pattern.product, begin) - first),
            product.begin() + 18 * (begin_of(pattern.product, end) - first), 0.0);
  for (std::int32_t i = begin; i < end; ++i) {
    for (std::int64_t s = A.first(i); s < A.last(i); ++s) {
      const Mat3 block = A.scale * A.block(s);
      for_same_columns(pattern.prolongation, A.column_of(s), pattern.product, i, 0,
                       [&](std::int64_t b, std::int64_t to) {
                         motion_at(product, to - first).noalias() +=
                             block.lazyProduct(motion_at(P, b).template cast<double>());
                       });
    }
  }
}

}  // namespace

CoarsePattern::CoarsePattern(const LevelMatrix& A, const Aggregates& aggregates) {
  const std::int32_t count = aggregates.count;
  const std::int32_t rows = A.rows();
  prolongation = pattern_of(rows, count, [&](std::int32_t i, auto&& add) {
    add(aggregates.of[static_cast<std::size_t>(i)]);
    if (A.mask(i) == 7) return;
    for (std::int64_t b = A.first(i); b < A.last(i); ++b) {
      add(aggregates.of[static_cast<std::size_t>(A.column_of(b))]);
    }
  });
  product = pattern_of(rows, count, [&](std::int32_t i, auto&& add) {
    for (std::int64_t b = A.first(i); b < A.last(i); ++b) {
      for (const std::int32_t a : prolongation.row(A.column_of(b))) add(a);
    }
  });
  for (std::int32_t i = 0; i < rows; ++i) {
    for (std::int64_t b = A.first(i); b < A.last(i); ++b) pairs += prolongation.length(A.column_of(b));
    pairs += 2 * prolongation.length(i) * product.length(i);
  }
  restriction = transposed(prolongation, count, place);
  matrix = pattern_of(count, count, [&](std::int32_t a, auto&& add) {
    add(a);
    for (const std::int32_t i : restriction.row(a)) {
      for (const std::int32_t c : product.row(i)) add(c);
    }
  });
}

std::size_t CoarsePattern::bytes() const {
  return prolongation.bytes() + product.bytes() + restriction.bytes() + matrix.bytes() +
         place.size() * sizeof(std::int64_t);
}

RowPattern twice_columns(const RowPattern& pattern) {
  RowPattern result;
  for (const std::int64_t begin : pattern.begin) result.begin.push_back(2 * begin);
  for (const std::int32_t c : pattern.column) result.column.insert(result.column.end(), {2 * c, 2 * c + 1});
  return result;
}

RowPattern twice_rows(const RowPattern& pattern) {
  RowPattern result;
  result.begin.assign(1, 0);
  for (std::int32_t i = 0; i < pattern.rows(); ++i) {
    for (int k = 0; k < 2; ++k) {
      const auto row = pattern.row(i);
      result.column.insert(result.column.end(), row.begin(), row.end());
      result.begin.push_back(static_cast<std::int64_t>(result.column.size()));
    }
  }
  return result;
}

RowPattern twice(const RowPattern& pattern) { return twice_rows(twice_columns(pattern)); }

template <class T>
void fill_prolongation(const LevelMatrix& A, const Aggregates& aggregates, const RowPlaces& fine,
                       const RowPlaces& coarse, const T* inverse, double w, const CoarsePattern& pattern,
                       const Threads& threads, BlockRows<T>& P) {
  const RowPattern& columns = pattern.prolongation;
  const auto aggregate = [&](std::int32_t row) { return aggregates.of[static_cast<std::size_t>(row)]; };
  threads.for_pieces(A.rows(), [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      const Mat3 D = w * A.scale *
                     Eigen::Map<const Eigen::Matrix<T, 3, 3>>(inverse + 9 * static_cast<std::ptrdiff_t>(i))
                         .template cast<double>();
      for (std::int64_t k = begin_of(columns, i); k < end_of(columns, i); ++k) {
        const std::int32_t a = columns.column[static_cast<std::size_t>(k)];
        Motion force = Motion::Zero();
        for (std::int64_t b = A.first(i); b < A.last(i); ++b) {
          const std::int32_t j = A.column_of(b);
          if (aggregate(j) == a)
            force.noalias() += A.block(b).lazyProduct(rigid_motion(A, fine, coarse, j, a));
        }
        Motion motion = -(D * force);
        if (aggregate(i) == a) motion += rigid_motion(A, fine, coarse, i, a);
        Eigen::Map<Eigen::Matrix<T, 3, 6>>(P.block(2 * k)) = motion.template cast<T>();
      }
    }
  });
}

template <class T>
void fill_restriction(const CoarsePattern& pattern, const BlockRows<T>& P, const Threads& threads,
                      BlockRows<T>& R) {
  using Block = Eigen::Matrix<T, 3, 3>;
  threads.for_pieces(pattern.restriction.rows(), [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t a = begin; a < end; ++a) {
      const std::int64_t first = begin_of(pattern.restriction, a);
      const std::int64_t count = end_of(pattern.restriction, a) - first;
      for (std::int64_t b = first; b < first + count; ++b) {
        const T* from = P.block(2 * pattern.place[static_cast<std::size_t>(b)]);
        for (int half = 0; half < 2; ++half) {
          Eigen::Map<Block>(R.block(first + half * count + b)) =
              Eigen::Map<const Block>(from + 9 * half).transpose();
        }
      }
    }
  });
}

namespace {

/// The rows of an aggregate in P^T A P: those of its translation lie before those of its rotation, 3x6 for
/// each aggregate that it meets.
struct AggregateRows {
  AggregateRows(const RowPattern& pattern, AlignedVector<double>& values, std::int32_t aggregate)
      : pattern_(pattern),
        a_(aggregate),
        moving_(values.data() + 36 * begin_of(pattern, aggregate)),
        turning_(moving_ + 18 * pattern.length(aggregate)) {}
  /// Of the block with this number in the pattern.
  [[nodiscard]] Eigen::Map<Motion> moving(std::int64_t block) const { return at(moving_, block); }
  [[nodiscard]] Eigen::Map<Motion> turning(std::int64_t block) const { return at(turning_, block); }

 private:
  [[nodiscard]] Eigen::Map<Motion> at(double* rows, std::int64_t block) const {
    return Eigen::Map<Motion>(rows + 18 * (block - begin_of(pattern_, a_)));
  }
  const RowPattern& pattern_;
  std::int32_t a_;
  double* moving_;
  double* turning_;
};

/// What was summed for columns from the diagonal on, mirrored, so that the matrix is symmetric whatever it
/// was summed from; and what nothing drives, held.
void complete_rows(const RowPattern& matrix, std::int32_t a, AlignedVector<double>& values) {
  const AggregateRows rows(matrix, values, a);
  const std::int64_t own = place_of(matrix, a, a);
  for (std::int64_t b = begin_of(matrix, a); b < own; ++b) {
    const std::int32_t c = matrix.column[static_cast<std::size_t>(b)];
    const AggregateRows other(matrix, values, c);
    const std::int64_t mirrored = place_of(matrix, c, a);
    rows.moving(b) << other.moving(mirrored).leftCols<3>().transpose(),
        other.turning(mirrored).leftCols<3>().transpose();
    rows.turning(b) << other.moving(mirrored).rightCols<3>().transpose(),
        other.turning(mirrored).rightCols<3>().transpose();
  }
  Eigen::Map<Motion> moving = rows.moving(own);
  Eigen::Map<Motion> turning = rows.turning(own);
  moving.leftCols<3>() = (0.5 * (moving.leftCols<3>() + moving.leftCols<3>().transpose())).eval();
  turning.rightCols<3>() = (0.5 * (turning.rightCols<3>() + turning.rightCols<3>().transpose())).eval();
  turning.leftCols<3>() = moving.rightCols<3>().transpose();
  hold_idle(moving.leftCols<3>(), 1.0);
  hold_idle(turning.rightCols<3>(), moving.leftCols<3>().diagonal().maxCoeff());
}

}  // namespace

template <class T>
void add_coarse_rows(const LevelMatrix& A, const CoarsePattern& pattern, const BlockRows<T>& P,
                     std::int32_t from, std::int32_t to, const Threads& threads, CoarseScratch& scratch,
                     AlignedVector<double>& values) {
  const RowPattern& matrix = pattern.matrix;
  const std::int64_t first = begin_of(pattern.product, from);
  const auto size = static_cast<std::size_t>(18 * (begin_of(pattern.product, to) - first));
  if (scratch.product.size() < size) scratch.product.resize(size);
  threads.for_pieces(to - from, [&](std::int32_t begin, std::int32_t end) {
    fill_product(A, pattern, P, from + begin, from + end, first, scratch.product);
  });
  threads.for_pieces(matrix.rows(), [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t a = begin; a < end; ++a) {
      const AggregateRows rows(matrix, values, a);
      std::int64_t& r = scratch.next[static_cast<std::size_t>(a)];
      for (; r < end_of(pattern.restriction, a); ++r) {
        const std::int32_t i = pattern.restriction.column[static_cast<std::size_t>(r)];
        if (i >= to) break;
        const Motion moved = motion_at(P, pattern.place[static_cast<std::size_t>(r)]).template cast<double>();
        for_same_columns(pattern.product, i, matrix, a, a, [&](std::int64_t b, std::int64_t c) {
          const Eigen::Map<Motion> force = motion_at(scratch.product, b - first);
          rows.moving(c).noalias() += moved.leftCols<3>().transpose().lazyProduct(force);
          rows.turning(c).noalias() += moved.rightCols<3>().transpose().lazyProduct(force);
        });
      }
    }
  });
}

template <class T>
std::int32_t fill_coarse_part(const LevelMatrix& A, const CoarsePattern& pattern, const BlockRows<T>& P,
                              std::int32_t from, std::int32_t rows, const Threads& threads,
                              CoarseScratch& scratch, AlignedVector<double>& values) {
  const RowPattern& matrix = pattern.matrix;
  if (from == 0) {
    values.resize(static_cast<std::size_t>(36 * matrix.blocks() + 1));
    scratch.next.resize(std::max(scratch.next.size(), static_cast<std::size_t>(matrix.rows())));
    threads.for_pieces(matrix.rows(), [&](std::int32_t begin, std::int32_t end) {
      std::fill(values.begin() + 36 * begin_of(matrix, begin), values.begin() + 36 * begin_of(matrix, end),
                0.0);
      for (std::int32_t a = begin; a < end; ++a) {
        scratch.next[static_cast<std::size_t>(a)] = begin_of(pattern.restriction, a);
      }
    });
  }
  const std::int32_t most = std::max(kLeastRows, A.rows() / kParts + 1);
  const std::int32_t last = std::min(A.rows(), rows < A.rows() - from ? from + rows : A.rows());
  for (; from < last; from += most) {
    add_coarse_rows(A, pattern, P, from, std::min(last, from + most), threads, scratch, values);
  }
  if (last < A.rows()) return last;
  threads.for_pieces(matrix.rows(), [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t a = begin; a < end; ++a) complete_rows(matrix, a, values);
  });
  return 0;
}

template void fill_prolongation(const LevelMatrix&, const Aggregates&, const RowPlaces&, const RowPlaces&,
                                const double*, double, const CoarsePattern&, const Threads&,
                                BlockRows<double>&);
template void fill_prolongation(const LevelMatrix&, const Aggregates&, const RowPlaces&, const RowPlaces&,
                                const float*, double, const CoarsePattern&, const Threads&,
                                BlockRows<float>&);
template void fill_restriction(const CoarsePattern&, const BlockRows<double>&, const Threads&,
                               BlockRows<double>&);
template void fill_restriction(const CoarsePattern&, const BlockRows<float>&, const Threads&,
                               BlockRows<float>&);
template std::int32_t fill_coarse_part(const LevelMatrix&, const CoarsePattern&, const BlockRows<double>&,
                                       std::int32_t, std::int32_t, const Threads&, CoarseScratch&,
                                       AlignedVector<double>&);
template std::int32_t fill_coarse_part(const LevelMatrix&, const CoarsePattern&, const BlockRows<float>&,
                                       std::int32_t, std::int32_t, const Threads&, CoarseScratch&,
                                       AlignedVector<double>&);

}  // namespace tissu
