#pragma once

/// The material of a whole body, cut or not: its surface, its cells, its pieces.

#include <array>
#include <cstdint>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"
#include "tissu/mesh/mesh.h"

namespace tissu {

/// Of sheets all triangles of the material but those on faces of volumes, of lines all pieces. Of volumes
/// closed: every edge is on as many triangles that run along it as on such that run against it. Of quadratic
/// cells the corners' chords are the surface; quads are cut at their lowest root.
struct MaterialSurface {
  std::vector<Rider> vertices;
  std::vector<std::int32_t> vertex_node;               ///< the node that a vertex is, or -1 - its rider
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< anticlockwise seen from outside
  std::vector<std::int32_t> cell;                      ///< host of each triangle
  std::vector<char> cut;                               ///< 1: opened by a cut
  std::vector<std::array<std::int32_t, 2>> lines;      ///< pieces of lines
  std::vector<std::int32_t> line_cell;                 ///< host of each piece
};
MaterialSurface material_surface(const Hosts& hosts, const Material& material);

/// Of volumes, then of sheets, then of lines: uncut cells as they are, then the tetrahedra, triangles or
/// pieces of lines of cut ones. A quad of an uncut
/// cell may meet two triangles of a cut one, which fill it.
struct MaterialMesh {
  std::vector<Rider> vertices;            ///< nodes of uncut cells and vertices of tetrahedra
  std::vector<std::int32_t> vertex_node;  ///< the node that a vertex is, or -1 - its rider
  std::vector<CellBlock> blocks;          ///< by places in `vertices`
  std::vector<std::int32_t> cell;         ///< host of each cell across the blocks
};
MaterialMesh material_mesh(const Hosts& hosts, const Material& material);

/// A connected part of the material. A host whose material is in several pieces is in each of them.
struct Piece {
  std::vector<std::int32_t> cells;  ///< ascending
  double volume;                    ///< at rest [m3]
};
/// By ascending first cells.
std::vector<Piece> pieces(const Hosts& hosts, const Material& material);

}  // namespace tissu
