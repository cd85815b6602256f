#pragma once

/// The material of cut cells: tetrahedra, of sheets triangles, of lines pieces of them, whose vertices are
/// nodes or ride on nodes.

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/edit/cut/hosts.h"

namespace tissu {

/// Stands in the last place of a triangle, and in the last two of a piece of a line.
inline constexpr std::int32_t kNoVertex = std::numeric_limits<std::int32_t>::max();

/// Vertex v >= 0 is node v; v < 0 is rider -1 - v. Positive volume at rest: vertex 3 lies on the side to
/// which the normal of 0 1 2 points. In a sheet it is a triangle, whose faces are its edges: the last of its
/// vertices is kNoVertex. In a line it is a piece between two vertices, whose faces are its ends: the face
/// opposite to vertex 0 is vertex 1.
struct MaterialTetra {
  std::array<std::int32_t, 4> vertices;
  std::uint8_t cut = 0;  ///< bit i: the face opposite to vertex i was opened by a cut

  /// 4, of a triangle 3, of a piece of a line 2; as many faces it has.
  [[nodiscard]] std::size_t corners() const {
    if (vertices[3] != kNoVertex) return 4;
    return vertices[2] == kNoVertex ? 2 : 3;
  }
};

/// What a blade that goes on knows of where it was: the vertices that lie on its cut, ascending.
struct Incision {
  std::int32_t number = -1;
  std::vector<std::int32_t> vertices = {};
  std::vector<std::int32_t> front = {};  ///< of these, where it goes on: the cut has not doubled them yet
};

/// Cells that no blade met have no entry: they are all material.
struct Material {
  std::vector<Rider> riders;
  std::map<std::int32_t, std::vector<MaterialTetra>> cells;  ///< by the number of the host
  std::vector<Incision> incisions;                           ///< ascending numbers

  /// The place of a vertex at places x of the nodes.
  [[nodiscard]] Vec3 at(std::int32_t vertex, ConstReals x) const;

  void apply(const CutPlan& plan);
  /// Takes out the material of hosts; what is left stays as it is.
  void remove(std::span<const std::int32_t> hosts);
};

/// The material of an uncut cell: a cone from its corner of lowest root over the faces that do not have that
/// corner, each quad face cut at its lowest root (Dompierre, Labbe, Vallet and Camarero, How to subdivide
/// pyramids, prisms and hexahedra into tetrahedra, 1999). A quad of a sheet is cut there too; a
/// triangle is its own, and so is a line. Cells of second order are the chords between their corners.
std::vector<MaterialTetra> whole_material(const Hosts& hosts, std::int32_t cell);

/// What is there of a cell, cut or not.
std::vector<MaterialTetra> material_of(const Hosts& hosts, const Material& material, std::int32_t cell);

/// Volume at rest [m3]; of a triangle of a sheet its area times the thickness of its host, of a piece of a
/// line its length times the area of the section.
double rest_volume(const Hosts& hosts, const Material& material, std::int32_t cell,
                   const MaterialTetra& tetra);

}  // namespace tissu
