#pragma once

/// The loop over the batches of a chunk, one for all models.

#include "tissu/base/batch.h"
#include "tissu/cell/chunk.h"

namespace tissu::TISSU_KERNELS {

/// Calls f(group, lane) for each batch of a chunk.
template <class Function>
TISSU_INLINE void for_batches(const Chunk& chunk, Function&& f) {
  for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
    for (int lane = 0; lane < kLanes; lane += kWidth) f(group, lane);
  }
}

/// Calls f(lanes, group, lane) with what `Lanes` makes of the view there.
template <class Lanes, class View, class Function>
TISSU_INLINE void for_batches(const View& view, const Chunk& chunk, Function&& f) {
  for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
    for (int lane = 0; lane < kLanes; lane += kWidth) f(Lanes(view, group, lane), group, lane);
  }
}

}  // namespace tissu::TISSU_KERNELS
