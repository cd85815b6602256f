#pragma once

/// Which tetrahedra unopened material joins.

#include <array>
#include <cstdint>
#include <vector>

#include "edit/cut/patch.h"

namespace tissu {

/// For each tetrahedron, across the face opposite to each vertex, the tetrahedron there; -1 where there is
/// none, the face is open, or one of the two is not `seen`. Where more than two triangles of a sheet share an
/// edge, each leads to the next one and the last to the first.
std::vector<std::array<std::int32_t, 4>> joins(const std::vector<Patch::Tetra>& tetrahedra,
                                               const std::vector<char>& seen);

}  // namespace tissu
