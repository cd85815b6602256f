#pragma once

/// A node goes to another one, and the cells between the two go.

#include <cstdint>
#include <optional>

#include "edit/repair/repair_mesh.h"

namespace tissu {

/// The node u goes to v, with which it has an edge. A node of the surface goes along an edge of the surface,
/// in the planes of all its faces; where a cut opened some of these and others not, along the border between
/// them. Nothing where that is not so, and where the edge may not be contracted (links.h). Volumes and
/// qualities are not looked at.
std::optional<Operation> collapse(const RepairMesh& mesh, std::int32_t u, std::int32_t v);

}  // namespace tissu
