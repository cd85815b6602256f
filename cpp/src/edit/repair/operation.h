#pragma once

/// One change of a few tetrahedra.

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tissu/edit/cut/hosts.h"

namespace tissu {

struct RepairCell {
  std::array<std::int32_t, 4> nodes;
  std::uint8_t cut = 0;      ///< bit i: the face opposite to node i was opened by a cut
  std::int32_t parent = -1;  ///< the cell of the body that it takes everything from

  [[nodiscard]] bool is_cut(std::size_t face) const { return (cut >> face & 1U) != 0; }
};

enum class Repair : std::uint8_t { collapse, flip, move };

struct Operation {
  Repair kind;
  std::vector<std::int32_t> patch;                              ///< numbers of the cells that it changes
  std::vector<std::pair<std::int32_t, RepairCell>> after = {};  ///< -1: a new one; else a cell that stays
  std::optional<NodeMove> move = std::nullopt;
  double least = 0.0;  ///< quality of the cells afterwards
};

/// The place of a node among those of a cell, 4 where it is not one.
inline std::size_t place_in(const RepairCell& cell, std::int32_t node) {
  std::size_t i = 0;
  while (i < 4 && cell.nodes[i] != node) ++i;
  return i;
}

}  // namespace tissu
