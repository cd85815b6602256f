#pragma once

/// How cells hang together: the outer surface, faces that do not match, connected parts.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tissu/mesh/mesh.h"

namespace tissu {

/// The faces that belong to one cell only, anticlockwise seen from outside, in the order of the cells. Faces
/// are the same when their corners are. Faces of linear cells stay whole; those of quadratic cells become
/// triangles between all their nodes: 4 for 6 nodes, 6 for 8, 8 for 9.
struct Surface {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> triangle_cell;  ///< cell number across the blocks
  std::vector<std::array<std::int32_t, 4>> quads;
  std::vector<std::int32_t> quad_cell;
};

Surface boundary_surface(const Mesh& mesh);

/// The same faces whole, in a block for each type: triangle, quad, triangle6, quad8, quad9.
struct FaceBlock {
  std::string_view type;
  std::vector<std::int32_t> nodes;  ///< face after face, VTK order, anticlockwise seen from outside
  std::vector<std::int32_t> cells;  ///< cell number across the blocks
};
std::vector<FaceBlock> boundary_face_blocks(const Mesh& mesh);

/// Number of faces that more than two cells share: cells there overlap.
std::int32_t overfull_face_count(const Mesh& mesh);

/// Places where cells touch without sharing a face, so that the field tears there.
struct NonconformingFaces {
  std::int32_t count = 0;           ///< places
  std::vector<std::int32_t> cells;  ///< numbers across the blocks of the cells there, increasing
};

/// A quad against two triangles, two triangles against two along the other diagonal (four corners in a plane,
/// to a tenth of a regular tetrahedron's quality), and faces with the same corners and other middles.
NonconformingFaces nonconforming_faces(const Mesh& mesh);

/// Part number of each cell, from 0 in the order of the first cells; cells that share a node are in one part.
std::vector<std::int32_t> connected_parts(const Mesh& mesh);

}  // namespace tissu
