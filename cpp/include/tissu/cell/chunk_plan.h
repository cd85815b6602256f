#pragma once

/// Where the cells of the first day stand. Cells that edits put in their places stand in the same chunks, so
/// that the order of a block follows from its cells, and not from the edits that led to them.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/cell/element_order.h"

namespace tissu {

struct ChunkPlan {
  std::vector<std::int32_t> chunk;   ///< of each cell of the first day, by its number; -1: of another block
  std::vector<std::int32_t> place;   ///< of the same, along the curve through its chunk
  std::vector<std::int32_t> colour;  ///< of each chunk; two that share a node differ

  [[nodiscard]] bool has(std::int32_t origin) const {
    return origin >= 0 && static_cast<std::size_t>(origin) < chunk.size() &&
           chunk[static_cast<std::size_t>(origin)] >= 0;
  }
};

/// Of a block on its first day; `numbers` are those of its cells in the body.
ChunkPlan plan_of(const ElementOrder& order, std::span<const std::int32_t> numbers);

/// The cells of a block with their numbers, and those of the cells of the first day that they come from.
struct PlannedCells {
  std::span<const std::int32_t> nodes;  ///< cell after cell
  int size = 0;
  std::span<const std::int32_t> numbers;
  std::span<const std::int32_t> origins;
};

/// The order by a plan: in each chunk along its curve, copies of a cell by their numbers. A chunk of more
/// cells than kernels take falls into equal parts, of which the first keeps the colour and each other one
/// stands alone.
ElementOrder order_by(const ChunkPlan& plan, const PlannedCells& cells);

/// Parts of a chunk of so many cells, and the first cell of each.
std::int32_t chunk_parts(std::size_t cells, int size);
inline std::size_t first_of_part(std::size_t cells, std::int32_t part, std::int32_t parts) {
  return cells * static_cast<std::size_t>(part) / static_cast<std::size_t>(parts);
}

}  // namespace tissu
