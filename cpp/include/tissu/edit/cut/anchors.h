#pragma once

/// Places that go with the material: a blade's last place moves as the tissue around it does.

#include <vector>

#include "tissu/base/vec.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// A place is rider.at(x) + offset.
struct Anchor {
  Rider rider;  ///< in the material the point itself, of sheets and lines the nearest; else a node
  Vec3 offset = Vec3::Zero();  ///< from there, in space [m]; zero in a volume
  bool inside = false;         ///< it is in the material, or near a sheet or line
};

/// Anchors of points, three numbers each, where the nodes are at x. Of tetrahedra that hold a point the one
/// in which it lies deepest counts, then the host of the lowest number; a point beside the material keeps its
/// offset from the nearest node that a cell uses, so that a body which moves past it passes it by as much. A
/// point within half an edge of a sheet or a line that does not lie on a volume keeps its offset from the
/// nearest point of it.
std::vector<Anchor> anchors(const Hosts& hosts, const Material& material, ConstReals x, ConstReals points);

}  // namespace tissu
