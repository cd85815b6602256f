#pragma once

/// Places on frames and whole numbers, as links and grabs keep them in the memory of a state.

#include <cmath>
#include <cstdint>

#include "tissu/state/state.h"

namespace tissu {

/// From a frame's origin to a place in its axes, in space; zero for a node, whose frame is below zero.
inline Vec3 lever_arm(const State& state, std::int32_t frame, const Vec3& place) {
  if (frame < 0) return Vec3::Zero();
  return state.rotations[static_cast<std::size_t>(frame)] * place;
}

/// Whether a number of the memory is whole, at least `from` and below `to`.
inline bool is_whole(double value, double from, double to) {
  return value == std::floor(value) && value >= from && value < to;
}

}  // namespace tissu
