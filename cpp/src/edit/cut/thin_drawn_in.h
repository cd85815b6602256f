#pragma once

/// Where contact meets the edges of cuts of sheets, and the ends of cut lines: a depth inside their own
/// material, as kerf.h says of the walls of volumes. Vertices at the front of a cut stay where they are.

#include <cstdint>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// What of the material of sheets and lines is in contact.
struct ThinMaterial {
  std::vector<MaterialTetra> triangles;
  std::vector<MaterialTetra> lines;
  std::set<std::int32_t> still;  ///< vertices that stay where they are, as those of volumes beside a sheet
};

/// What carries the vertices that are drawn in, ascending. `depth`: of each vertex at rest [m]; thin
/// material has less of it, so that a triangle keeps its sense and a line its direction.
std::vector<std::pair<std::int32_t, Rider>> drawn_in(const Hosts& hosts, const Material& material,
                                                     const ThinMaterial& thin,
                                                     const std::function<double(std::int32_t)>& depth);

}  // namespace tissu
