#pragma once

/// The surface of the volumes of a body as contact meets it: the walls of a cut begin apart.
///
/// At the moment of the cut both walls stand in one place, where neither has a side. So a vertex of a wall
/// is met a depth inside its own material, as if the blade had a thickness. It stays in one tetrahedron of
/// the material beside it, so that walls are apart wherever the material is not inside out. Vertices at the
/// front of a cut, which both walls share, stay where they are.

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

struct KerfSurface {
  /// Nodes, and riders as -1 - number; anticlockwise seen from outside. Quads of cells that no blade met are
  /// cut along their shorter diagonals.
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// Of each vertex below zero, and of nodes on walls, ascending: what carries it.
  std::vector<std::pair<std::int32_t, Rider>> carried;
};

/// `depth`: of walls inside their material at rest [m]; thin material has less of it. 0: walls coincide.
KerfSurface kerf_surface(const Hosts& hosts, const Material& material, double depth);

}  // namespace tissu
