#pragma once

/// Where contact meets the vertices on the walls of cuts: a depth inside their own material.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "edit/cut/material_faces.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// Vertices of the surface, and whether another one stands in the same place.
using TwinFlags = std::map<std::int32_t, bool>;

/// What carries those of the vertices that are drawn in. `all`: at least the faces of all cells that have one
/// of them. `depth` at rest [m]; thin material has less of it.
std::vector<std::pair<std::int32_t, Rider>> drawn_in(const Hosts& hosts, const Material& material,
                                                     const MaterialFaces& all, const TwinFlags& vertices,
                                                     double depth);

}  // namespace tissu
