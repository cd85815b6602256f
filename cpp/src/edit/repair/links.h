#pragma once

/// Whether an edge may be contracted without a change of what hangs together.

#include <cstdint>

#include "edit/repair/repair_mesh.h"

namespace tissu {

/// The condition of Dey, Edelsbrunner, Guha and Nekhayev (Topology preserving edge contraction, 1999) in
/// three dimensions: Lk u and Lk v meet in Lk uv alone, where the surface is closed by a node outside. The
/// links of both ends must be spheres, as they are where the body does not touch itself.
bool may_contract(const RepairMesh& mesh, std::int32_t u, std::int32_t v);

}  // namespace tissu
