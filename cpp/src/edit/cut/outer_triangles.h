#pragma once

/// The triangles of the surface of a body's volumes.

#include <array>
#include <cstdint>
#include <vector>

#include "edit/cut/material_faces.h"
#include "tissu/edit/cut/hosts.h"

namespace tissu {

struct OuterTriangle {
  std::array<std::int32_t, 3> vertices;  ///< anticlockwise seen from outside
  bool cut;                              ///< a blade opened it
};
struct OuterTriangles {
  std::int32_t cell;
  std::vector<OuterTriangle> triangles;
};

/// Of the cells that have some, ascending. Quads of cells that no blade met are cut along their shorter
/// diagonals.
std::vector<OuterTriangles> outer_triangles(const Hosts& hosts, const MaterialFaces& all);

}  // namespace tissu
