#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tissu/model/frames/frame_points.h"

namespace tissu {

struct FramesOptions {
  static constexpr std::string_view kName = "frames";
  std::string tangent = "full";   ///< full or material
  std::string section = "whole";  ///< of sheets and lines: whole or middle
  /// The share of the way from frame to point that rotations turn: whole, as published, or half, which bends
  /// to a curvature with the rotations of the material (linked interpolation). Empty: half along sheets and
  /// lines whose section is whole, else whole.
  std::string lever = {};
  /// Of frames without cells: their points; `cells` of the block holds the frames of each. Null: the cells'
  /// own.
  std::shared_ptr<const FramePoints> points = nullptr;
};

}  // namespace tissu
