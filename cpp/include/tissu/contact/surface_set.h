#pragma once

/// The surfaces of a world as detection reads them: vertices, edges and primitives numbered across all
/// bodies and obstacles. Constant for a topology.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tissu/contact/broad_phase.h"
#include "tissu/contact/description.h"
#include "tissu/state/state.h"

namespace tissu {

/// A triangle, an edge that belongs to no triangle, or a vertex that belongs to no edge.
struct Primitive {
  std::array<std::int32_t, 3> vertex;
  int corners;  ///< 3, 2 or 1
};

/// Every edge and every vertex belongs to its lowest primitive, so that each pair is made once. Where wedges
/// of a closed surface touch along an edge, each of them has its own.
struct SurfaceEdge {
  std::array<std::int32_t, 2> vertex;
  std::array<std::int32_t, 2> face = {-1, -1};    ///< the first two triangles beside it
  std::array<std::int32_t, 2> across = {-1, -1};  ///< the vertex of each that is not on the edge
  double length = 0.0;                            ///< at rest [m]
  [[nodiscard]] bool is_lone() const { return face[0] < 0; }
};

/// A rigid body that carries a vertex: p = x + R arm.
struct SurfaceCarrier {
  std::int32_t frame = -1;     ///< number in State::rotations
  std::int32_t row = -1;       ///< of its origin
  std::int32_t rotation = -1;  ///< the row of its rotation
};

struct SurfaceVertex {
  std::int32_t row = -1;      ///< of the unknown; -1: of an obstacle
  std::int32_t carrier = -1;  ///< of a free obstacle: number among the carriers
  std::int32_t node = 0;      ///< number in its body or obstacle
  std::int32_t surface = 0;
  double radius = 0.0;  ///< [m]
  double area = 0.0;    ///< a third of its triangles' at rest [m2]
  bool has_faces = false;
  bool is_lone = false;  ///< it has no edge
  /// Unknowns move it; else it is at rest or led.
  [[nodiscard]] bool is_free() const { return row >= 0 || carrier >= 0; }
};

class SurfaceSet {
 public:
  /// `first_node`: the row of each body's first node; `frames`: of the world; `rest`: positions of all rows.
  SurfaceSet(const ContactDescription& description, std::span<const std::int32_t> first_node, ConstReals rest,
             std::span<const Frame> frames = {});

  struct Surface {
    std::string name;
    std::int32_t first_vertex;
    std::int32_t last_vertex;
    bool closed;
    std::int32_t obstacle;      ///< -1: a body
    std::int32_t carrier = -1;  ///< of a free obstacle: number among the carriers
  };
  [[nodiscard]] const std::vector<Surface>& surfaces() const { return surfaces_; }
  [[nodiscard]] const std::vector<SurfaceVertex>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<SurfaceEdge>& edges() const { return edges_; }
  [[nodiscard]] const std::vector<Primitive>& primitives() const { return primitives_; }
  /// Of vertices at rest [m]; those of obstacles before their motion.
  [[nodiscard]] const std::vector<double>& rest() const { return rest_; }
  /// Rigid bodies that carry free obstacles.
  [[nodiscard]] const std::vector<SurfaceCarrier>& carriers() const { return carriers_; }
  /// From the origin of the rigid body that carries a vertex, in its own axes [m].
  [[nodiscard]] const Vec3& arm(std::int32_t vertex) const {
    return arms_[static_cast<std::size_t>(vertex - first_carried_)];
  }
  /// The first primitive of each surface, and the end.
  [[nodiscard]] const std::vector<std::int32_t>& first_primitive() const { return first_primitive_; }

  /// Vertices and edges that belong to a primitive, …
  [[nodiscard]] std::span<const std::int32_t> vertices_of(std::int32_t primitive) const;
  [[nodiscard]] std::span<const std::int32_t> edges_of(std::int32_t primitive) const;
  /// … the edges of a triangle, opposite its third, first and second corner (01, 12, 20), …
  [[nodiscard]] const std::array<std::int32_t, 3>& triangle_edges(std::int32_t primitive) const {
    return triangle_edges_[static_cast<std::size_t>(primitive)];
  }
  /// … the primitive that a vertex belongs to, and the other ends of its edges.
  [[nodiscard]] std::int32_t owner(std::int32_t vertex) const {
    return owner_[static_cast<std::size_t>(vertex)];
  }
  [[nodiscard]] std::span<const std::int32_t> neighbours(std::int32_t vertex) const;
  [[nodiscard]] std::int32_t surface_of_primitive(std::int32_t primitive) const;
  /// The mean length of a surface's edges at rest [m]; 0 where it has none.
  [[nodiscard]] double mean_edge(std::int32_t surface) const {
    return mean_edge_[static_cast<std::size_t>(surface)];
  }
  [[nodiscard]] std::size_t bytes() const;

 private:
  void add(const SurfaceDescription& description, std::int32_t first_row, std::int32_t obstacle,
           ConstReals rest);
  /// The vertices of the latest surface are those of a free obstacle about `origin`.
  void carry(const Frame& frame, std::int32_t number, const Vec3& origin);
  std::vector<std::int32_t> add_edges(std::int32_t first_primitive, std::int32_t first_vertex);
  void number_edges(std::int32_t first_primitive, std::int32_t first_edge);
  void part_wedges(const std::vector<std::int32_t>& crowded, std::int32_t first_primitive,
                   std::int32_t first_edge);
  void measure(std::int32_t first_primitive, std::int32_t first_edge);
  void list_neighbours();

  std::vector<Surface> surfaces_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<SurfaceEdge> edges_;
  std::vector<Primitive> primitives_;
  std::vector<std::array<std::int32_t, 3>> triangle_edges_;
  std::vector<double> rest_;
  std::vector<std::int32_t> first_primitive_ = {0};
  std::vector<std::int32_t> owner_;
  std::vector<std::int32_t> own_vertex_, own_vertex_begin_, own_edge_, own_edge_begin_;
  std::vector<std::int32_t> neighbour_, neighbour_begin_;
  std::vector<double> mean_edge_;
  std::vector<SurfaceCarrier> carriers_;
  std::vector<Vec3> arms_;  ///< of vertices from the first that is carried on
  std::int32_t first_carried_ = 0;
};

}  // namespace tissu
