#pragma once

/// The cells beside a cell, by how many of its corners they have.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "tissu/edit/cut/hosts.h"

namespace tissu {

/// Calls f(other, shared) for each cell at a corner of a cell, itself included, in ascending number: the
/// lists of the corners are merged. `shared`: how many of the corners are nodes of the other.
template <class Function>
void for_cells_at_corners(const Hosts& hosts, std::int32_t cell, Function&& f) {
  constexpr std::size_t kMostCorners = 8;
  constexpr std::int32_t kEnd = std::numeric_limits<std::int32_t>::max();
  std::array<std::span<const std::int32_t>, kMostCorners> rest;
  std::size_t count = 0;
  for (const std::int32_t node : hosts.corners(cell)) rest[count++] = hosts.cells_at(node);
  for (;;) {
    std::int32_t next = kEnd;
    for (std::size_t i = 0; i < count; ++i) {
      if (!rest[i].empty()) next = std::min(next, rest[i].front());
    }
    if (next == kEnd) return;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (rest[i].empty() || rest[i].front() != next) continue;
      rest[i] = rest[i].subspan(1);
      ++shared;
    }
    f(next, shared);
  }
}

}  // namespace tissu
