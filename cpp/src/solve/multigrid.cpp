#include "multigrid.h"

#include <algorithm>
#include <cmath>

#include "work.h"

namespace tissu {
namespace {

constexpr std::int32_t kDirect = 80;  ///< rows of a level that gets a factor
constexpr double kCoarser = 0.7;      ///< rows that a next level has at most, of those of its finer one
constexpr double kOverrelaxed = 4.0 / 3.0;
constexpr double kPairBytes = 400;    ///< what a product of a block with a motion costs, in bytes read
constexpr double kPart = 2.0;         ///< iterations that a solve may spend on a making in parts
constexpr double kLeastPart = 0.1;    ///< iterations: less than that is left to the next solve
constexpr double kNewSmoother = 1.5;  ///< cycles of smoothing that a new smoother takes
constexpr double kNewTransfer = 1.5;  ///< and the prolongation of its level
constexpr double kFirstShift = 1e-10;

}  // namespace

template <class T>
void Multigrid<T>::make(const LinearOperator& A, double scale) {
  const bool bound = !levels_.empty() && (direct_ || levels_.size() > 1);
  if (!complete_ || !bound || id_ != A.id() || given_ != A.given()) levels_.clear();
  complete_ = false;
  id_ = A.id();
  given_ = A.given();
  isa_ = A.matrix()->isa();
  threads_ = A.matrix()->threads();
  const bool fresh = levels_.empty();
  direct_ = false;
  if (fresh) start(fine_matrix(A, scale));
  take(A);
  for (std::size_t n = 0; refresh(n, A, scale, fresh); ++n) {
    if (fresh) levels_.push_back(std::make_unique<Level>());
    project(n, A, scale);
  }
  finish(A, scale);
  once_ = fresh ? kAggregation * A.rows() : 0.0;
}

/// Parts in turn: of each level the smoother with its prolongation, its largest eigenvalue where it is
/// measured, and the matrix of the next level, a few rows at a time. What is new works with what is old: each
/// part is of a matrix that was given lately.
template <class T>
bool Multigrid<T>::make_part(const LinearOperator& A, double scale) {
  const bool couples = has_couplings_ || A.couplings() != nullptr;  // its parts would not fit each other
  if (!complete_ || couples || id_ != A.id() || given_ != A.given()) {
    make(A, scale);
    return true;
  }
  for (double left = kPart; left > kLeastPart || part_ == Part::prolongation;) {
    Level& level = *levels_[part_level_];
    switch (part_) {
      case Part::smoother:
        if (part_level_ == 0) {
          take(A);
          renewals_ = (renewals_ + 1) % kMeasured;
        }
        if (!smooths(part_level_, A, scale)) {
          finish(A, scale);
          once_ = 0.0;
          return true;
        }
        level.smoother.make(level_matrix(part_level_, A, scale), isa_, threads_, false);
        left -= kNewSmoother * level.smoother.cycle_bytes() / iteration_bytes_;
        part_ = renewals_ == 0 ? Part::eigenvalue : Part::prolongation;
        break;
      case Part::eigenvalue:
        if (left < kPart) return false;  // the longest part of all, in a solve of its own
        level.smoother.find_largest(threads_);
        part_ = Part::prolongation;
        return false;
      case Part::prolongation:
        if (!level.pattern) {  // the coarsest level
          finish(A, scale);
          once_ = 0.0;
          return true;
        }
        fill_transfer(part_level_, A, scale);
        left -= kNewTransfer * level.smoother.cycle_bytes() / iteration_bytes_;
        row_ = 0;
        part_ = Part::next_matrix;
        break;
      case Part::next_matrix: {
        const double whole = kPairBytes * static_cast<double>(level.pattern->pairs) / iteration_bytes_;
        const double rows = static_cast<double>(level.smoother.rows());
        const auto some =
            static_cast<std::int32_t>(std::clamp(std::ceil(rows * left / std::max(whole, 1e-9)), 1.0, rows));
        left -= whole * some / rows;
        row_ = fill_coarse_part(level_matrix(part_level_, A, scale), *level.pattern, level.P, row_, some,
                                threads_, scratch_, level.next_values);
        if (row_ > 0) continue;
        levels_[++part_level_]->places = level.next_places;
        part_ = Part::smoother;
        break;
      }
    }
  }
  return false;
}

template <class T>
void Multigrid<T>::finish(const LinearOperator& A, double scale) {
  if (direct_) factor(level_matrix(levels_.size() - 1, A, scale));
  set_price(A);
  complete_ = true;
  part_ = Part::smoother;
  part_level_ = 0;
}

template <class T>
LevelMatrix Multigrid<T>::fine_matrix(const LinearOperator& A, double scale) const {
  const BlockMatrix& matrix = *A.matrix();
  return {&matrix.sparsity().row_begin, &matrix.sparsity().column, matrix.values(), scale, given_,
          matrix.sparsity().row_end()};
}

template <class T>
LevelMatrix Multigrid<T>::level_matrix(std::size_t n, const LinearOperator& A, double scale) const {
  LevelMatrix level = fine_matrix(A, scale);
  if (n > 0) {
    const Level& finer = *levels_[n - 1];
    level = {&finer.next_pattern.begin, &finer.next_pattern.column, finer.next_values.data(), 1.0, nullptr};
  }
  if (has_couplings_) {
    level.couplings = &levels_[n]->couplings;
    level.coupling_scale = scale;
  }
  return level;
}

/// Whether a level is smoothed; else it is the last one, which its factor solves.
template <class T>
bool Multigrid<T>::smooths(std::size_t n, const LinearOperator& A, double scale) const {
  return level_matrix(n, A, scale).rows() > kDirect;
}

template <class T>
bool Multigrid<T>::refresh(std::size_t n, const LinearOperator& A, double scale, bool fresh) {
  if (!smooths(n, A, scale)) {
    direct_ = true;
    return false;
  }
  Level& fine = *levels_[n];
  const LevelMatrix level = level_matrix(n, A, scale);
  fine.smoother.make(level, isa_, threads_, true);
  if (fresh && !coarsen(level, fine)) return false;
  if (!fine.pattern) return false;
  fill_transfer(n, A, scale);
  return true;
}

template <class T>
void Multigrid<T>::fill_transfer(std::size_t n, const LinearOperator& A, double scale) {
  Level& fine = *levels_[n];
  place_aggregates(fine.aggregates, fine.places, fine.next_places);
  fine.P.refer(fine.prolongation.begin, fine.prolongation.column, isa_);
  fine.R.refer(fine.restriction.begin, fine.restriction.column, isa_);
  fill_prolongation(level_matrix(n, A, scale), fine.aggregates, fine.places, fine.next_places,
                    fine.smoother.inverse(), kOverrelaxed / fine.smoother.largest(), *fine.pattern, threads_,
                    fine.P);
  fill_restriction(*fine.pattern, fine.P, threads_, fine.R);
}

template <class T>
void Multigrid<T>::project(std::size_t n, const LinearOperator& A, double scale) {
  Level& fine = *levels_[n];
  Level& coarse = *levels_[n + 1];
  coarse.places = fine.next_places;
  fill_coarse_matrix(level_matrix(n, A, scale), *fine.pattern, fine.P, threads_, scratch_, fine.next_values);
  if (!has_couplings_) return;
  coarsen_couplings(fine.couplings, fine.aggregates, fine.places, coarse.places, carried_, coarse.couplings);
}

/// Of the first level: where its rows are, and what couples them.
template <class T>
void Multigrid<T>::take(const LinearOperator& A) {
  Level& first = *levels_.front();
  if (A.places() != nullptr) first.places = *A.places();
  has_couplings_ = A.couplings() != nullptr;
  if (has_couplings_) first.couplings = *A.couplings();
}

/// The first level; its rows are points at one place until others are known.
template <class T>
void Multigrid<T>::start(const LevelMatrix& A) {
  levels_.push_back(std::make_unique<Level>());
  RowPlaces& places = levels_.front()->places;
  places.positions.assign(3 * static_cast<std::size_t>(A.rows()), 0.0);
  places.point.resize(static_cast<std::size_t>(A.rows()));
  for (std::int32_t i = 0; i < A.rows(); ++i) places.point[static_cast<std::size_t>(i)] = i;
}

template <class T>
bool Multigrid<T>::coarsen(const LevelMatrix& A, Level& level) const {
  level.aggregates = aggregate(A, level.places);
  const std::int32_t rows = 2 * level.aggregates.count;
  if (rows == 0 || rows > kCoarser * A.rows()) return false;
  level.pattern = std::make_unique<CoarsePattern>(A, level.aggregates);
  level.prolongation = twice_columns(level.pattern->prolongation);
  level.restriction = twice_rows(level.pattern->restriction);
  level.next_pattern = twice(level.pattern->matrix);
  level.change.resize(3 * static_cast<std::size_t>(A.rows()));
  level.right.resize(3 * static_cast<std::size_t>(rows));
  level.answer.resize(level.right.size());
  return true;
}

template <class T>
void Multigrid<T>::factor(const LevelMatrix& A) {
  const Eigen::Index size = 3 * A.rows();
  dense_.setZero(size, size);
  for (std::int32_t i = 0; i < A.rows(); ++i) {
    for (std::int64_t b = A.first(i); b < A.last(i); ++b) {
      dense_.block<3, 3>(3 * i, 3 * A.column_of(b)) = A.scale * A.block(b);
    }
  }
  if (A.couplings != nullptr) {
    A.couplings->for_blocks([&](std::int32_t row, std::int32_t column, const Mat3& value) {
      dense_.block<3, 3>(3 * row, 3 * column) += A.coupling_scale * value;
    });
  }
  vector_.resize(size);
  const double size_of_diagonal = std::max(dense_.diagonal().cwiseAbs().maxCoeff(), 1e-300);
  factor_.compute(dense_);
  for (double shift = kFirstShift; factor_.info() != Eigen::Success && shift < 1e6; shift *= 10.0) {
    dense_.diagonal().array() += shift * size_of_diagonal;
    factor_.compute(dense_);
  }
}

template <class T>
void Multigrid<T>::cycle(std::size_t number, const T* b, T* x) {
  Level& level = *levels_[number];
  const bool last = number + 1 == levels_.size();
  if (last && direct_) {
    for (Eigen::Index i = 0; i < vector_.size(); ++i) vector_[i] = static_cast<double>(b[i]);
    factor_.solveInPlace(vector_);
    for (Eigen::Index i = 0; i < vector_.size(); ++i) x[i] = static_cast<T>(vector_[i]);
    return;
  }
  level.smoother.smooth_from_zero(threads_, b, x);
  if (last) return;
  level.R.multiply(threads_, level.smoother.residual(), level.right.data());
  cycle(number + 1, level.right.data(), level.answer.data());
  threads_.for_pieces(level.P.rows(), [&](std::int32_t begin, std::int32_t end) {
    level.P.multiply_rows(begin, end, level.answer.data(), level.change.data());
    for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
      x[i] += level.change[i];
    }
  });
  level.smoother.smooth(threads_, b, x);
}

template <class T>
void Multigrid<T>::apply(std::span<const T> r, std::span<T> z) {
  cycle(0, r.data(), z.data());
}

template <class T>
void Multigrid<T>::set_price(const LinearOperator& A) {
  double cycle = 0.0;
  double made = 0.0;
  for (const auto& level : levels_) {
    const double smoothing = level->smoother.rows() > 0 ? level->smoother.cycle_bytes() : 0.0;
    cycle += smoothing;
    made += 3.0 * smoothing;  // its largest eigenvalue takes three times the products of a cycle
    if (!level->pattern) continue;
    cycle += static_cast<double>(level->P.bytes() + level->R.bytes());
    made += kPairBytes * static_cast<double>(level->pattern->pairs);
  }
  iteration_bytes_ = static_cast<double>(A.bytes()) + kVectorBytes * A.rows() + cycle;
  price_ = made / iteration_bytes_;
  making_ = made;
  application_ = cycle;
}

template <class T>
std::size_t Multigrid<T>::bytes() const {
  std::size_t sum = static_cast<std::size_t>(2 * dense_.size()) * sizeof(double) + scratch_.bytes();
  for (const auto& level : levels_) {
    sum += level->smoother.bytes() + level->P.bytes() + level->R.bytes();
    sum += (level->next_values.size() + level->places.positions.size()) * sizeof(double);
    sum += (level->right.size() + level->answer.size() + level->change.size()) * sizeof(T);
    sum += level->prolongation.bytes() + level->restriction.bytes() + level->next_pattern.bytes();
    sum += (level->aggregates.of.size() + level->places.point.size()) * sizeof(std::int32_t);
    if (level->pattern) sum += level->pattern->bytes();
  }
  return sum;
}

template <class T>
std::vector<std::int32_t> Multigrid<T>::level_rows() const {
  std::vector<std::int32_t> rows;
  rows.reserve(levels_.size());
  for (const auto& level : levels_) rows.push_back(static_cast<std::int32_t>(level->places.point.size()));
  return rows;
}

template class Multigrid<double>;
template class Multigrid<float>;

}  // namespace tissu
