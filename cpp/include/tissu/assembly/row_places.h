#pragma once

#include <cstdint>
#include <vector>

namespace tissu {

/// Where the rows of a matrix are, which says how a rigid motion moves each: the translation of a point at x
/// by t + w x (x - c), a rotation by w.
struct RowPlaces {
  std::vector<double> positions;    ///< [row][3]; of a rotation, those of its point [m]
  std::vector<std::int32_t> point;  ///< the row of the point that a rotation belongs to; itself for a point

  [[nodiscard]] bool is_rotation(std::int32_t row) const {
    return point[static_cast<std::size_t>(row)] != row;
  }
};

}  // namespace tissu
