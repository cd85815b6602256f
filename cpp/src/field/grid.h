#pragma once

/// A regular, axis-aligned grid recognised from its positions.

#include <array>
#include <optional>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// Positions at every combination of the coordinates of three axes, whose spacing may vary along an axis.
struct Grid {
  std::array<std::vector<double>, 3> coordinates;  ///< ascending [m]
  std::vector<std::int32_t> numbers;               ///< of the positions; x runs fastest, then y

  [[nodiscard]] std::int32_t number(const std::array<std::size_t, 3>& place) const {
    return numbers[place[0] + coordinates[0].size() * (place[1] + coordinates[1].size() * place[2])];
  }
};

/// Coordinates that differ by less than 1e-9 of the greatest extent are one. Nothing where the positions are
/// not each place of a grid once.
std::optional<Grid> find_grid(ConstReals positions);

}  // namespace tissu
