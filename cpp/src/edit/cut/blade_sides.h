#pragma once

/// Which material a sweep divides, and whether a cut has left it joined.

#include <cstdint>
#include <vector>

#include "edit/cut/near.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/sweep.h"

namespace tissu {

/// Vertices between which the edges of the material lead without a touch of the sweep have the same side.
/// A face of the material between crossed edges is covered by a flat convex blade. So two vertices of
/// different sides are on different sides of such a blade, within the patch.
class BladeSides {
 public:
  /// The patch before the sweep cuts it. `near`: of each part of the sweep.
  BladeSides(const Patch& patch, const Sweep& sweep, const std::vector<NearCells>& near);

  /// After the cut: cells (places, ascending) across which faces that are not open join material of two
  /// sides. `on`: of each vertex, 1: on the cut, which may pass it on either side.
  [[nodiscard]] std::vector<std::int32_t> joined(const Patch& patch, const std::vector<char>& on) const;

 private:
  std::vector<std::int32_t> side_;  ///< of each vertex
};

}  // namespace tissu
