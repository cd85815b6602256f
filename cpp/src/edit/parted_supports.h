#pragma once

/// Supports of a body whose nodes part.

#include <vector>

#include "tissu/world/description.h"

namespace tissu {

/// Copies of held nodes are held as those are, wherever they have material. A copy without material is held
/// where it is needed: if its cell has material on a face, an edge or a cell all of whose nodes the support
/// held on the first day. The displacement there is interpolated between all of these nodes, and it could not
/// differ from theirs before the cut either. A node that a blade put on an edge is held where the support
/// held all nodes of the first day that it lies between. `copied`: what the last nodes of the body are copies
/// of; -1 - i for the place body.points[i].
void part_supports(WorldDescription& description, const BodyDescription& body,
                   const std::vector<std::int32_t>& copied);

/// After cells were removed: frees the copies without material that no cell needs any more.
void free_unneeded(WorldDescription& description, const BodyDescription& body);

}  // namespace tissu
