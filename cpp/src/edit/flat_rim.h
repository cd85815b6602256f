#pragma once

/// The rim of a flat body, which is its surface in contact.

#include <array>
#include <cstdint>
#include <vector>

#include "edit/cut/kerf.h"
#include "edit/cut/thin_drawn_in.h"
#include "tissu/world/description.h"

namespace tissu {

/// Whether the cells of a body stay in a plane.
bool is_flat(const BodyDescription& body);

/// A cell of a rim: its nodes, of which the first are its corners.
struct FlatCells {
  std::size_t nodes;
  std::size_t corners;
  std::vector<std::int32_t> cells;
};

/// The edges that one cell alone has, along which it lies on the left seen from +z, in the order in which the
/// compilation of a scene has them (python/tissu/mesh/flat_edges.py). Edges with a node in the middle are
/// two.
std::vector<std::array<std::int32_t, 2>> rim_of(ConstReals points, const std::vector<FlatCells>& all);

/// The same of the material of a body that blades met, edges of cuts included. `rest` is that of the nodes.
std::vector<std::array<std::int32_t, 2>> rim_of(ConstReals rest, const Material& material,
                                                const std::vector<MaterialTetra>& triangles);

}  // namespace tissu
