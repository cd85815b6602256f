#pragma once

/// Which cells a blade may meet, and which of its triangles may meet each.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/sweep.h"

namespace tissu {

class NearCells {
 public:
  /// Boxes are tested, and planes of triangles against boxes; none that meets is left out.
  NearCells(const Hosts& hosts, ConstReals x, const SweepPart& part);

  /// Numbers of hosts, ascending.
  [[nodiscard]] const std::vector<std::int32_t>& cells() const { return cells_; }
  /// The triangles that may meet a cell, ascending; none for cells that are not near.
  [[nodiscard]] std::span<const std::int32_t> triangles(std::int32_t cell) const;

 private:
  std::vector<std::int32_t> cells_;
  std::vector<std::int32_t> first_;  ///< of each cell in `triangles_`, and the end
  std::vector<std::int32_t> triangles_;
};

}  // namespace tissu
