#pragma once

/// Which tetrahedra unopened material joins.

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "edit/cut/patch.h"

namespace tissu {

/// Disjoint sets of numbers from 0, with path halving. The lowest number of a set stands for it.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t first(std::int32_t i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = first(a);
    b = first(b);
    if (a < b) {
      parent(b) = a;
    } else {
      parent(a) = b;
    }
  }

 private:
  std::int32_t& parent(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<std::int32_t> parent_;
};

/// For each tetrahedron, across the face opposite to each vertex, the tetrahedron there; -1 where there is
/// none, the face is open, or one of the two is not `seen`. Where more than two triangles of a sheet share an
/// edge, each leads to the next one and the last to the first.
std::vector<std::array<std::int32_t, 4>> joins(const std::vector<Patch::Tetra>& tetrahedra,
                                               const std::vector<char>& seen);

}  // namespace tissu
