#pragma once

/// Tissue of which points have lost frames: a blade severed them.

#include <memory>
#include <string_view>
#include <vector>

#include "tissu/model/frames/frame_points.h"
#include "tissu/world/description.h"
#include "tissu/world/world.h"

namespace tissu {

/// What tissue is made of instead: points that are left, with numbers among its own frames and, after those,
/// the nodes of other bodies that it still shares.
struct TissuePoints {
  std::vector<SharedNode> shared;
  FramePoints points;
};

/// A new world with these points in a tissue. Frames without a point are held at `places`, three numbers for
/// each of its own frames [m], and do not turn. Refuses a world that was not compiled for editing, a body
/// that is not tissue, and what a world refuses.
std::shared_ptr<const World> with_points(const World& world, std::string_view tissue, TissuePoints left,
                                         ConstReals places);

}  // namespace tissu
