#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// A box along the axes, closed: boxes that touch overlap. In single precision, rounded outwards, so that it
/// holds all that it was made of.
struct Box {
  std::array<float, 3> low;
  std::array<float, 3> high;

  /// Holds nothing; grows by `add`.
  static Box none();
  void add(const Vec3& point);
  void add(const Box& other);
  void grow(double by);
  [[nodiscard]] bool overlaps(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
  }
};

}  // namespace tissu
