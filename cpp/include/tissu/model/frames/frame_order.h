#pragma once

/// The order in which points among frames are worked through: points of the same frames stand together in
/// groups of eight lanes, groups in chunks, and two chunks of one colour share no frame, so that they may add
/// to a matrix at the same time. Forces need no colours: each point leaves its shares, and each frame adds up
/// those that are its own.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/array.h"

namespace tissu {

struct FrameOrder {
  static constexpr std::int32_t kLanes = 8;
  static constexpr std::int32_t kChunk = 16;  ///< groups of a chunk

  struct Range {
    std::int32_t begin;
    std::int32_t end;
  };

  std::vector<std::int32_t> point;         ///< [group][lane]: number of the point
  std::vector<std::uint8_t> real;          ///< [group][lane]: 0 for a lane that only pads
  std::vector<std::uint8_t> shared;        ///< [group]: all lanes have the same frames
  std::vector<Range> chunks;               ///< of groups, sorted by colour
  std::vector<std::int32_t> colour_begin;  ///< colours + 1, first chunk of each colour
  std::vector<std::int64_t> share_begin;   ///< frames + 1: where each frame's places in `share` begin
  std::vector<std::int32_t> share;         ///< (group k + a) kLanes + lane, ascending for each frame

  [[nodiscard]] std::int32_t groups() const { return static_cast<std::int32_t>(point.size()) / kLanes; }
  [[nodiscard]] std::int32_t colours() const { return static_cast<std::int32_t>(colour_begin.size()) - 1; }
};

/// `frames` holds k frames for each point, numbers below `count`.
FrameOrder order_points(std::span<const std::int32_t> frames, int k, std::int32_t count);

}  // namespace tissu
