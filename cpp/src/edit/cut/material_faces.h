#pragma once

/// The faces of all material of a body, and the units that they join.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// A unit is an uncut cell or a tetrahedron of a cut one.
struct MaterialUnit {
  std::int32_t cell;   ///< number of the host
  std::int32_t tetra;  ///< place in the host's list; -1: the whole cell
};

/// A triangle of the border of a unit, anticlockwise seen from outside; quads are cut at their lowest root.
/// Of a triangle of a sheet an edge, with kNoVertex in the place of a vertex; of a line one vertex.
struct MaterialFace {
  std::array<std::int32_t, 3> vertices;
  std::int32_t unit;
  bool cut;
  std::int32_t across;  ///< a face of another unit that this one is joined to, -1: it is on the surface
};

struct MaterialFaces {
  std::vector<MaterialUnit> units;  ///< by ascending cells
  std::vector<MaterialFace> faces;  ///< unit after unit
  /// Units of sheets and lines, each with one of a higher dimension that it goes with (carriers.h).
  std::vector<std::pair<std::int32_t, std::int32_t>> carried;
};
/// `dimension`: of these cells alone; 0: of all.
MaterialFaces material_faces(const Hosts& hosts, const Material& material, int dimension = 0);
/// Of some volume cells, ascending: faces that are joined to other cells count as on the surface.
MaterialFaces faces_among(const Hosts& hosts, const Material& material, std::span<const std::int32_t> cells);

}  // namespace tissu
