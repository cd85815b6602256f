#pragma once

/// Disjoint sets of numbers, which are joined until they stay.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace tissu {

/// Numbers from 0, each in a set of its own at first. The lowest number of a set stands for it.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The number that stands for the set of i.
  std::int32_t first(std::int32_t i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = first(a);
    b = first(b);
    if (a > b) std::swap(a, b);
    parent(b) = a;
  }

 private:
  std::int32_t& parent(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<std::int32_t> parent_;
};

}  // namespace tissu
