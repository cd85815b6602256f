#pragma once

/// Rows that move together: each aggregate is a row of points and a row of rotations of the next coarser
/// level of a multigrid.

#include <cstdint>
#include <vector>

#include "tissu/assembly/couplings.h"
#include "tissu/assembly/row_places.h"
#include "tissu/base/vec.h"

namespace tissu {

/// A matrix in double, as a level of the multigrid is made from it.
struct LevelMatrix {
  const std::vector<std::int64_t>* begin;
  const std::vector<std::int32_t>* column;
  const double* values;                    ///< [block][9], column by column
  double scale;                            ///< each of its values counts times this
  const std::vector<std::uint8_t>* given;  ///< axes of each row that are those of the identity; null: none
  const std::int64_t* end = nullptr;       ///< of each row; null: where the next one begins
  const Couplings* couplings = nullptr;    ///< beside it; null: none
  double coupling_scale = 1.0;             ///< they count times this

  [[nodiscard]] std::int32_t rows() const { return static_cast<std::int32_t>(begin->size()) - 1; }
  [[nodiscard]] std::int64_t first(std::int32_t row) const { return (*begin)[static_cast<std::size_t>(row)]; }
  [[nodiscard]] std::int64_t last(std::int32_t row) const {
    return end == nullptr ? (*begin)[static_cast<std::size_t>(row) + 1] : end[row];
  }
  [[nodiscard]] std::int32_t column_of(std::int64_t b) const {
    return (*column)[static_cast<std::size_t>(b)];
  }
  [[nodiscard]] Eigen::Map<const Mat3> block(std::int64_t b) const {
    return Eigen::Map<const Mat3>(values + 9 * b);
  }
  [[nodiscard]] unsigned mask(std::int32_t row) const {
    return given == nullptr ? 0U : (*given)[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] Mat3 diagonal(std::int32_t row) const;
  /// The same with the couplings.
  [[nodiscard]] Mat3 coupled_diagonal(std::int32_t row) const;
};

struct Aggregates {
  std::int32_t count = 0;
  std::vector<std::int32_t> of;      ///< of each row; -1 for one that is given, or that no other binds
  std::vector<std::int32_t> points;  ///< rows of each that are points
};

/// Neighbourhoods of strongly coupled points, so that each lies in one (Vanek, Mandel and Brezina, Algebraic
/// multigrid by smoothed aggregation, Computing 56, 1996); a rotation goes with its point.
Aggregates aggregate(const LevelMatrix& A, const RowPlaces& places);

/// The aggregates as points at their centres and rotations about these.
void place_aggregates(const Aggregates& aggregates, const RowPlaces& fine, RowPlaces& coarse);

}  // namespace tissu
