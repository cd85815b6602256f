#include "aggregates.h"

#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

/// Blocks below this share of their diagonal blocks do not bind: a stiff part does not take a soft one along.
constexpr double kStrong = 0.02;
constexpr unsigned kAll = 7;

/// Which points are strongly coupled.
class Gathering {
 public:
  Gathering(const LevelMatrix& A, const RowPlaces& places) : A_(A), places_(places) {
    const auto rows = static_cast<std::size_t>(A.rows());
    size_.resize(rows);
    result_.of.assign(rows, kFree);
    for (std::int32_t i = 0; i < A.rows(); ++i) {
      size_[static_cast<std::size_t>(i)] = free_diagonal(i).squaredNorm();
      if (places.is_rotation(i) || A.mask(i) == kAll) of(i) = -1;
    }
  }
  Aggregates run() {
    for (std::int32_t i = 0; i < A_.rows(); ++i) {
      if (of(i) == kFree && has_free_neighbourhood(i)) gather(i);
    }
    join_neighbours();
    for (std::int32_t i = 0; i < A_.rows(); ++i) {
      if (of(i) == kFree && has_neighbour(i)) gather(i);
    }
    std::ranges::replace(result_.of, kFree, -1);
    for (std::int32_t i = 0; i < A_.rows(); ++i) {
      const std::int32_t point = places_.point[static_cast<std::size_t>(i)];
      if (point != i && A_.mask(i) != kAll) of(i) = of(point);
    }
    count_points();
    return std::move(result_);
  }

 private:
  static constexpr std::int32_t kFree = -2;
  void count_points() {
    result_.points.assign(static_cast<std::size_t>(result_.count), 0);
    for (std::int32_t i = 0; i < A_.rows(); ++i) {
      if (of(i) >= 0 && !places_.is_rotation(i)) ++result_.points[static_cast<std::size_t>(of(i))];
    }
  }
  std::int32_t& of(std::int32_t row) { return result_.of[static_cast<std::size_t>(row)]; }
  /// Without the axes that are given, whose ones have no unit in common with it.
  [[nodiscard]] Mat3 free_diagonal(std::int32_t i) const {
    Mat3 D = A_.diagonal(i);
    for (int k = 0; k < 3; ++k) {
      if (((A_.mask(i) >> k) & 1U) == 0) continue;
      D.row(k).setZero();
      D.col(k).setZero();
    }
    return D;
  }
  [[nodiscard]] double strength(std::int32_t i, std::int64_t b) const {
    const auto j = static_cast<std::size_t>(A_.column_of(b));
    const double limit = kStrong * kStrong;
    const double square = A_.block(b).squaredNorm() * A_.scale * A_.scale;
    const double diagonal = std::sqrt(size_[static_cast<std::size_t>(i)] * size_[j]);
    return square > limit * diagonal ? square / std::max(diagonal, 1e-300) : 0.0;
  }
  /// Calls f(neighbour, strength) until it returns false.
  template <class Function>
  void for_strong(std::int32_t i, Function&& f) const {
    for (std::int64_t b = A_.first(i); b < A_.last(i); ++b) {
      const std::int32_t j = A_.column_of(b);
      if (j == i || places_.is_rotation(j) || A_.mask(j) == kAll) continue;
      const double s = strength(i, b);
      if (s > 0.0 && !f(j, s)) return;
    }
  }
  bool has_free_neighbourhood(std::int32_t i) {
    bool free = true;
    bool any = false;
    for_strong(i, [&](std::int32_t j, double) {
      any = true;
      free = of(j) == kFree;
      return free;
    });
    return free && any;
  }
  bool has_neighbour(std::int32_t i) {
    bool any = false;
    for_strong(i, [&](std::int32_t, double) {
      any = true;
      return false;
    });
    return any;
  }
  /// A new aggregate of a point and what is free around it.
  void gather(std::int32_t i) {
    const std::int32_t number = result_.count++;
    of(i) = number;
    for_strong(i, [&](std::int32_t j, double) {
      if (of(j) == kFree) of(j) = number;
      return true;
    });
  }
  /// What is left goes to the aggregate of its strongest neighbour.
  void join_neighbours() {
    const std::vector<std::int32_t> before = result_.of;
    for (std::int32_t i = 0; i < A_.rows(); ++i) {
      if (before[static_cast<std::size_t>(i)] != kFree) continue;
      double best = 0.0;
      for_strong(i, [&](std::int32_t j, double s) {
        if (before[static_cast<std::size_t>(j)] >= 0 && s > best) {
          best = s;
          of(i) = before[static_cast<std::size_t>(j)];
        }
        return true;
      });
    }
  }

  const LevelMatrix& A_;
  const RowPlaces& places_;
  std::vector<double> size_;  ///< squared norms of the diagonal blocks
  Aggregates result_;
};

}  // namespace

Mat3 LevelMatrix::diagonal(std::int32_t row) const {
  const auto columns = column->begin();
  const auto found = std::lower_bound(columns + first(row), columns + last(row), row);
  return scale * block(found - columns);
}

Mat3 LevelMatrix::coupled_diagonal(std::int32_t row) const {
  const Mat3 own = diagonal(row);
  const std::int32_t place = couplings == nullptr ? -1 : couplings->place(row);
  return place < 0 ? own : Mat3(own + coupling_scale * couplings->diagonal(place));
}

Aggregates aggregate(const LevelMatrix& A, const RowPlaces& places) { return Gathering(A, places).run(); }

void place_aggregates(const Aggregates& aggregates, const RowPlaces& fine, RowPlaces& coarse) {
  const auto count = static_cast<std::size_t>(aggregates.count);
  coarse.positions.assign(6 * count, 0.0);
  coarse.point.resize(2 * count);
  for (std::size_t i = 0; i < aggregates.of.size(); ++i) {
    const std::int32_t a = aggregates.of[i];
    if (a < 0 || fine.is_rotation(static_cast<std::int32_t>(i))) continue;
    block(Reals(coarse.positions), 2 * a) += block(ConstReals(fine.positions), static_cast<std::int32_t>(i));
  }
  for (std::int32_t a = 0; a < aggregates.count; ++a) {
    block(Reals(coarse.positions), 2 * a) /= aggregates.points[static_cast<std::size_t>(a)];
    block(Reals(coarse.positions), 2 * a + 1) = block(ConstReals(coarse.positions), 2 * a);
    coarse.point[static_cast<std::size_t>(2 * a)] = 2 * a;
    coarse.point[static_cast<std::size_t>(2 * a + 1)] = 2 * a;
  }
}

}  // namespace tissu
