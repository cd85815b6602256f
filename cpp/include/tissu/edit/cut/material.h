#pragma once

/// The material of cut cells: tetrahedra whose vertices are nodes or ride on nodes.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/edit/cut/hosts.h"

namespace tissu {

/// A point of the material as weights of nodes, which sum to 1. A tetrahedron of the material lies inside one
/// between four corners of its host, so that four pairs are enough.
struct Rider {
  std::array<std::int32_t, 4> node{-1, -1, -1, -1};
  std::array<double, 4> weight{};
  std::int32_t count = 0;

  /// sum w x_node
  [[nodiscard]] Vec3 at(ConstReals x) const;
};

/// Vertex v >= 0 is node v; v < 0 is rider -1 - v. Positive volume at rest: vertex 3 lies on the side to
/// which the normal of 0 1 2 points.
struct MaterialTetra {
  std::array<std::int32_t, 4> vertices;
  std::uint8_t cut = 0;  ///< bit i: the face opposite to vertex i was opened by a cut
};

/// What a blade that goes on knows of where it was: the vertices that lie on its cut, ascending.
struct Incision {
  std::int32_t number;
  std::vector<std::int32_t> vertices;
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
/// pyramids, prisms and hexahedra into tetrahedra, 1999).
std::vector<MaterialTetra> whole_material(const Hosts& hosts, std::int32_t cell);

}  // namespace tissu
