#pragma once

/// The order in which a block's elements are worked through. Elements near each other in space stand together
/// in chunks; the chunks have colours, and two of one colour share no node, so that they may run at the same
/// time and every node still receives its forces in one order, whatever the number of threads.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/base/vec.h"
#include "tissu/cell/chunk.h"

namespace tissu {

struct ElementOrder {
  static constexpr int kLanes = 8;
  /// Elements of a chunk: few enough for the nodes of its elements to fit a kernel's copy.
  static constexpr std::int32_t chunk_size(int nodes) { return nodes <= 10 ? 256 : 128; }

  /// Groups from `begin` to before `end`.
  struct Run {
    std::int32_t begin;
    std::int32_t end;
  };

  std::vector<std::int32_t> element;       ///< [group][lane]: number of the element
  std::vector<std::uint8_t> real;          ///< [group][lane]: 0 for a lane that only pads
  std::vector<Chunk> chunks;               ///< sorted by colour
  std::vector<std::int32_t> colour_begin;  ///< colours + 1, first chunk of each colour
  std::vector<std::int32_t> nodes;         ///< of all chunks, ascending in each
  std::vector<Run> runs;                ///< groups in the order of sums over all cells; empty: as they stand
  AlignedVector<std::uint16_t> places;  ///< [group][node][lane]: 4 times its number in its chunk

  ElementOrder() = default;
  ElementOrder(ElementOrder&&) = default;
  ElementOrder& operator=(ElementOrder&&) = default;
  ElementOrder(const ElementOrder&) = delete;  // chunks point into `nodes`
  ElementOrder& operator=(const ElementOrder&) = delete;
  ~ElementOrder() = default;

  [[nodiscard]] std::int32_t groups() const { return static_cast<std::int32_t>(element.size()) / kLanes; }
  [[nodiscard]] std::int32_t colours() const { return static_cast<std::int32_t>(colour_begin.size()) - 1; }
};

/// `cells` holds cell after cell of `size` node numbers. `together`, a number for each cell where it is not
/// empty: cells of one number, no more than a chunk has, stand in one chunk. `fill`: the share of a chunk
/// that is laid full, whole groups of lanes; less than 1 leaves room for cells that an edit puts beside those
/// that it cuts.
ElementOrder order_elements(std::span<const std::int32_t> cells, int size, ConstReals positions,
                            std::span<const std::int32_t> together = {}, double fill = 1.0);

}  // namespace tissu
