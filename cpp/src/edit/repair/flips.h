#pragma once

/// Other tetrahedra between the same nodes.

#include <cstdint>
#include <vector>

#include "edit/repair/repair_mesh.h"

namespace tissu {

/// What may go of a mesh in a flip: no face or edge all of whose nodes are kept.
using KeptNodes = std::vector<char>;

/// The flips 2-3 at the faces of a cell, and 3-2 and 4-4 at its edges. Faces of the surface and those that a
/// cut opened stay. Volumes and qualities are not looked at.
std::vector<Operation> flips_of(const RepairMesh& mesh, std::int32_t cell, const KeptNodes& kept);

}  // namespace tissu
