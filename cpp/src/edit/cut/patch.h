#pragma once

/// The material around a cut, in which edges are divided.

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// A copy of the material of some cells, whole ones included. Its vertices, tetrahedra and cells have places
/// of their own; all places and new numbers follow from the order of the cells' numbers.
class Patch {
 public:
  struct Vertex {
    std::int32_t number;  ///< as `MaterialTetra` has it; new riders follow the last one
    Rider rider;
    Vec3 place;  ///< now [m]
    Vec3 rest;   ///< [m]
  };
  /// Of a sheet a triangle: the last vertex is -1, and faces are edges. Of a line a piece: the last two are
  /// -1.
  struct Tetra {
    std::array<std::int32_t, 4> vertices;
    std::int32_t cell;
    std::uint8_t cut;

    [[nodiscard]] std::size_t corners() const {
      if (vertices[3] >= 0) return 4;
      return vertices[2] < 0 ? 2 : 3;
    }
  };
  struct Cell {
    std::int32_t number;
    bool stored;       ///< the material has a list for it
    bool sound;        ///< every tetrahedron of it has a volume (area, length) above 0 at rest
    double size;       ///< longest edge of the first day [m]
    double thickness;  ///< of a sheet [m], of a line its section [m2]; 1 for a volume
    bool divided = false;
    bool opened = false;
  };

  /// `cells`: numbers, ascending.
  Patch(const Hosts& hosts, const Material& material, ConstReals x, const std::vector<std::int32_t>& cells);

  /// Adds those of the cells that the patch does not have; no divided edge may be theirs.
  void extend(const Hosts& hosts, const Material& material, ConstReals x,
              const std::vector<std::int32_t>& cells);
  /// The place of the cell of that number, -1 when the patch does not have it.
  [[nodiscard]] std::int32_t cell_of(std::int32_t number) const;

  /// The place of the vertex of that number, -1 when the patch does not have it.
  [[nodiscard]] std::int32_t place_of(std::int32_t number) const;
  [[nodiscard]] const std::vector<std::int32_t>& tetrahedra_at(std::int32_t vertex) const {
    return at_[static_cast<std::size_t>(vertex)];
  }
  /// The tetrahedra that have the edge p q.
  [[nodiscard]] std::vector<std::int32_t> around(std::int32_t p, std::int32_t q) const;
  /// Puts a vertex on the edge p q, at the share t of the way from p, and divides every tetrahedron around in
  /// two. Returns the vertex.
  std::int32_t divide(std::int32_t p, std::int32_t q, double t);

  [[nodiscard]] const Vertex& vertex(std::int32_t i) const { return vertices[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Tetra& tetra(std::int32_t i) const { return tetrahedra[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Cell& cell(std::int32_t i) const { return cells[static_cast<std::size_t>(i)]; }
  /// [m3], of a triangle its area [m2], of a line its length [m].
  [[nodiscard]] double rest_volume(const Tetra& tetra) const;

  /// Whether it has pieces of several dimensions.
  [[nodiscard]] bool is_mixed() const { return (dimensions_ & (dimensions_ - 1U)) != 0; }

  /// Of the pieces that a thin one may go with where a blade parts them, the one on its side.
  struct Chosen {
    std::int32_t thin;
    std::uint8_t face;  ///< of the thin piece; kWholePiece: all its vertices
    std::int32_t carrier;
  };

  /// A vertex that was put on an edge, and the edge's ends (places).
  struct Division {
    std::int32_t vertex;
    std::int32_t p;
    std::int32_t q;
  };

  std::vector<Vertex> vertices;
  std::vector<Tetra> tetrahedra;
  std::vector<Cell> cells;
  std::vector<Division> divisions;  ///< one after the other
  std::vector<Chosen> chosen;       ///< of several for the same face the last one counts
  std::int32_t old_riders;          ///< of the material; new riders of the patch follow
  std::int32_t new_riders = 0;      ///< vertices put on edges

 private:
  void add_cell(const Hosts& hosts, const Material& material, ConstReals x, std::int32_t number);
  std::int32_t vertex_of(std::int32_t number, const Hosts& hosts, const Material& material, ConstReals x);

  std::vector<std::vector<std::int32_t>> at_;
  unsigned dimensions_ = 0;  ///< a bit for each that pieces have
  std::unordered_map<std::int32_t, std::int32_t> places_;
  std::unordered_map<std::int32_t, std::int32_t> cell_places_;
};

/// (1 - t) p + t q, pairs of the same node added.
Rider between(const Rider& p, const Rider& q, double t);

/// Stands for all vertices of a thin piece where a number of a face is asked for.
inline constexpr std::uint8_t kWholePiece = 4;

/// The face of a tetrahedron that lies opposite to vertex i, anticlockwise seen from outside. Of a triangle,
/// the first three: each has place 3, where no vertex is. Of a line the first two, each with places 2 and 3.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kOpposite{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace tissu
