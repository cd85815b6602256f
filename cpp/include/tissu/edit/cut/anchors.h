#pragma once

/// Places that go with the material: a blade's last place moves as the tissue around it does.

#include <vector>

#include "tissu/base/vec.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// A place is rider.at(x) + offset.
struct Anchor {
  Rider rider;                 ///< in the material the point itself; beside it the nearest node
  Vec3 offset = Vec3::Zero();  ///< from there, in space [m]; zero in the material
  bool inside = false;         ///< it is in the material
};

/// Anchors of points, three numbers each, where the nodes are at x. Of tetrahedra that hold a point the one
/// in which it lies deepest counts, then the host of the lowest number; a point beside the material keeps its
/// offset from the nearest node that a cell uses, so that a body which moves past it passes it by as much.
std::vector<Anchor> anchors(const Hosts& hosts, const Material& material, ConstReals x, ConstReals points);

}  // namespace tissu
