#pragma once

/// Where contact cuts a quad in two.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// Cuts a quad along its shorter diagonal, of equal ones along that of the node of lowest `rank`.
template <class Rank>
void add_halves(ConstReals points, const std::array<std::int32_t, 4>& quad, Rank&& rank,
                std::vector<std::array<std::int32_t, 3>>& triangles) {
  constexpr double kSame = 1e-9;  // share by which diagonals may differ and count as equal
  const double first = (block(points, quad[2]) - block(points, quad[0])).norm();
  const double second = (block(points, quad[3]) - block(points, quad[1])).norm();
  const bool equal = std::abs(first - second) <= kSame * (first + second);
  const bool lowest = (std::ranges::min_element(quad, {}, rank) - quad.begin()) % 2 == 0;
  const bool along_first = equal ? lowest : first < second;
  triangles.push_back({quad[0], quad[1], along_first ? quad[2] : quad[3]});
  triangles.push_back({along_first ? quad[0] : quad[1], quad[2], quad[3]});
}

}  // namespace tissu
