#pragma once

/// What a kernel works through at a time.

#include <cstdint>

namespace tissu {

/// Some groups, and the nodes of the world that their elements use. A kernel copies these side by side, works
/// on the copy in the first-level cache, and adds each node's sum to the world once.
struct Chunk {
  static constexpr std::int32_t kMostNodes = 4096;
  std::int32_t begin;  ///< groups
  std::int32_t end;
  const std::int32_t* nodes;
  std::int32_t node_count;
};

}  // namespace tissu
