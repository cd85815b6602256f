#pragma once

/// The order in which a block's elements are worked through. Elements near each other in space stand together
/// in chunks; the chunks have colours, and two of one colour share no node, so that they may run at the same
/// time and every node still receives its forces in one order, whatever the number of threads.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/force/elastic_kernels.h"

namespace tissu {

struct ElementOrder {
  static constexpr int kLanes = 8;
  static constexpr std::int32_t kChunk = 256;  ///< elements

  std::vector<std::int32_t> element;       ///< [group][lane]: number of the element
  std::vector<std::uint8_t> real;          ///< [group][lane]: 0 for a lane that only pads
  std::vector<GroupRange> chunks;          ///< sorted by colour
  std::vector<std::int32_t> colour_begin;  ///< colours + 1, first chunk of each colour

  [[nodiscard]] std::int32_t groups() const { return static_cast<std::int32_t>(element.size()) / kLanes; }
  [[nodiscard]] std::int32_t colours() const { return static_cast<std::int32_t>(colour_begin.size()) - 1; }
};

/// `cells` holds cell after cell of `size` node numbers.
ElementOrder order_elements(std::span<const std::int32_t> cells, int size, ConstReals positions);

}  // namespace tissu
