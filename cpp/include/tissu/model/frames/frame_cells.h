#pragma once

/// The points of a mesh whose nodes are frames: the quadrature points of its cells, with the shape functions
/// of the cells as weights. Hexahedra make trilinear frames (8 neighbours), tetrahedra linear ones (4).
/// Sheets get two points through the thickness, at the places of Gauss, and lines four around the axis, whose
/// moments of area are those of their section; or one each on the middle, which feels no bending (sheet)
/// and no twist (line) but by the turning of neighbours against each other.

#include "tissu/model/elastic_block.h"
#include "tissu/model/frames/frame_points.h"

namespace tissu {

/// Refuses cells that are inverted or have no volume. `frames` of the result are those of block.cells.
FramePoints points_of_cells(const ElasticBlock& block, ConstReals rest_positions);

}  // namespace tissu
