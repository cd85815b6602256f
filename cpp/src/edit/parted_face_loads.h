#pragma once

/// Dead loads on faces of a body that was edited.

#include "tissu/edit/cut_state.h"
#include "tissu/world/description.h"

namespace tissu {

/// Lets a load act on what is left of its faces. Each part of a face gives it to the nodes of the cell that
/// has the material there, by the shape functions on that part, whether there is material at these nodes or
/// not: so each piece of a body has the load of its own area. Nodes that had it first come first, in their
/// order; others that bear some of it follow.
void part_face_load(LoadDescription& load, const CutState& cut);

}  // namespace tissu
