#pragma once

/// Outward directions of the faces of the material.

#include "edit/cut/patch.h"

namespace tissu {

/// Twice the area of a face of a tetrahedron, outward; of an edge of a triangle its length, outward in the
/// plane of that; of an end of a line its length. `at`: the present places, or those at rest.
Vec3 outward(const Patch& patch, const Patch::Tetra& tetra, std::size_t face, Vec3 Patch::Vertex::*at);

}  // namespace tissu
