#include "grid.h"

#include <algorithm>

namespace tissu {
namespace {

constexpr double kSame = 1e-9;

/// The greatest extent along an axis.
double extent(ConstReals positions) {
  Vec3 low = block(positions, 0);
  Vec3 high = low;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(positions.size() / 3); ++i) {
    low = low.cwiseMin(block(positions, i));
    high = high.cwiseMax(block(positions, i));
  }
  return (high - low).maxCoeff();
}

/// The different coordinates along an axis, ascending.
std::vector<double> different(ConstReals positions, std::size_t axis, double tolerance) {
  std::vector<double> values;
  for (std::size_t i = axis; i < positions.size(); i += 3) values.push_back(positions[i]);
  std::ranges::sort(values);
  std::vector<double> kept;
  for (const double value : values) {
    if (kept.empty() || value - kept.back() > tolerance) kept.push_back(value);
  }
  return kept;
}

}  // namespace

std::optional<Grid> find_grid(ConstReals positions) {
  const std::size_t count = positions.size() / 3;
  const double tolerance = kSame * extent(positions);
  Grid grid;
  std::size_t places = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.coordinates[axis] = different(positions, axis, tolerance);
    places *= grid.coordinates[axis].size();
    if (places > count) return std::nullopt;
  }
  if (places != count) return std::nullopt;
  grid.numbers.assign(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t place = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const auto& values = grid.coordinates[axis];
      const auto after = std::ranges::upper_bound(values, positions[3 * i + axis]);
      place = place * values.size() + static_cast<std::size_t>(after - values.begin()) - 1;
    }
    if (grid.numbers[place] >= 0) return std::nullopt;
    grid.numbers[place] = static_cast<std::int32_t>(i);
  }
  return grid;
}

}  // namespace tissu
