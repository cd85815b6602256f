#pragma once

/// A node inside goes to another place among its cells.

#include <cstdint>
#include <vector>

#include "edit/repair/repair_mesh.h"

namespace tissu {

/// Moves of the nodes of a cell that are not on the surface: towards the mean of their neighbours, and away
/// from the opposite face of the cell. Of each node the one that leaves the best cells, if these are better
/// than before.
std::vector<Operation> shifts_of(const RepairMesh& mesh, std::int32_t cell,
                                 const std::vector<char>& may_move);

}  // namespace tissu
