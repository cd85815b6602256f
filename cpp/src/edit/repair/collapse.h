#pragma once

/// A node goes to another one, and the cells between the two go.

#include <cstdint>
#include <optional>

#include "edit/repair/repair_mesh.h"

namespace tissu {

/// The node u goes to v, with which it has an edge. A node of the surface goes along an edge of the surface,
/// in the planes of all its faces. Where these are of several planes, or a cut opened some and others not, or
/// at the front of a cut, it goes along the ridge between them, if that is straight. Nothing where that is
/// not so, and where the edge may not be contracted (links.h). Volumes and qualities are not looked at.
std::optional<Operation> collapse(const RepairMesh& mesh, std::int32_t u, std::int32_t v);

}  // namespace tissu
