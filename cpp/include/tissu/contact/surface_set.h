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
  bool is_flat = false;                           ///< inside a plane of what is rigid
  [[nodiscard]] bool is_lone() const { return face[0] < 0; }
};

/// A rigid body that carries a vertex: p = x + R arm.
struct SurfaceCarrier {
  std::int32_t frame = -1;     ///< number in State::rotations
  std::int32_t row = -1;       ///< of its origin
  std::int32_t rotation = -1;  ///< the row of its rotation
};

/// A row that carries a vertex of a body, beside others: p = sum weight x.
struct RiderPart {
  std::int32_t row;
  double weight;
  std::int32_t mover;  ///< number among the movers
};

/// Where that row belongs to a frame, whose rotation carries the vertex too: p = sum weight (x + R arm).
struct RiderTurn {
  std::int32_t frame = -1;  ///< number in State::rotations; -1: no rotation
  std::int32_t row = -1;    ///< of the rotation
  Vec3 arm = Vec3::Zero();  ///< in the axes of the frame [m]
};

/// A rotation that carries vertices, or turns what is round about them.
struct SurfaceRotation {
  std::int32_t frame;  ///< number in State::rotations
  std::int32_t row;
  std::int32_t mover;  ///< of the frame's origin; -1: of a free obstacle, or it leaves all vertices in place
};

struct SurfaceVertex {
  std::int32_t row = -1;      ///< of the unknown that it is; -1: of an obstacle, or several carry it
  std::int32_t carrier = -1;  ///< of a free obstacle: number among the carriers
  std::int32_t rider = -1;    ///< number among the vertices that rows carry
  std::int32_t roller = -1;   ///< of a line's node that is a frame: number among the rollers
  std::int32_t node = 0;      ///< number in its body or obstacle; negative: the vertex is not a node
  std::int32_t surface = 0;
  double radius = 0.0;  ///< [m]
  double area = 0.0;    ///< a third of its triangles' at rest [m2]
  bool has_faces = false;
  bool is_lone = false;  ///< it has no edge
  bool is_flat = false;  ///< all its edges are
  /// Unknowns move it; else it is at rest or led.
  [[nodiscard]] bool is_free() const { return row >= 0 || carrier >= 0 || rider >= 0; }
  /// What moves it is deformed.
  [[nodiscard]] bool is_soft() const { return row >= 0 || rider >= 0; }
  /// What is there stops as a whole when the vertex does: a rigid body, or a sheet or line through its
  /// thickness. Of a volume, the skin stops, and what lies behind it goes on.
  [[nodiscard]] bool stops_whole() const { return carrier >= 0 || (is_soft() && radius > 0.0); }
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
    std::int32_t obstacle;        ///< -1: a body
    std::int32_t carrier = -1;    ///< of a free obstacle: number among the carriers
    std::int32_t first_row = -1;  ///< of a body: that of its first node
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

  /// Frames in the middle of lines, whose surface turns with them where it rubs.
  struct Roller {
    std::int32_t frame;     ///< number in State::rotations
    std::int32_t rotation;  ///< the row of its rotation
  };
  [[nodiscard]] const Roller& roller(const SurfaceVertex& vertex) const {
    return rollers_[static_cast<std::size_t>(vertex.roller)];
  }
  /// Whether anything round turns with unknowns.
  [[nodiscard]] bool has_rolling() const { return !carriers_.empty() || !rollers_.empty(); }

  /// Whether rows carry any vertex.
  [[nodiscard]] bool has_riders() const { return !rider_part_.empty(); }
  /// The rows that carry a vertex, which has to be a rider.
  [[nodiscard]] std::span<const RiderPart> parts(const SurfaceVertex& vertex) const {
    const auto first = static_cast<std::size_t>(rider_begin_[static_cast<std::size_t>(vertex.rider)]);
    const auto last = static_cast<std::size_t>(rider_begin_[static_cast<std::size_t>(vertex.rider) + 1]);
    return std::span(rider_part_).subspan(first, last - first);
  }
  /// The rotations beside the rows that carry a vertex, as many as `parts`; empty where none turns any
  /// vertex.
  [[nodiscard]] std::span<const RiderTurn> turns(const SurfaceVertex& vertex) const {
    if (rider_turn_.empty()) return {};
    const auto first = static_cast<std::size_t>(rider_begin_[static_cast<std::size_t>(vertex.rider)]);
    return std::span(rider_turn_).subspan(first, parts(vertex).size());
  }
  /// What rotations have of the place of a vertex: sum weight R arm.
  [[nodiscard]] Vec3 turned(const SurfaceVertex& vertex, std::span<const Quaternion> rotations) const;
  /// Whether rotations of frames carry any vertex of a body.
  [[nodiscard]] bool has_turning_riders() const { return !rider_turn_.empty(); }
  /// Rotations that carry vertices: of free obstacles, then those of frames of bodies.
  [[nodiscard]] const std::vector<SurfaceRotation>& rotations() const { return rotations_; }
  /// A row that carries vertices and is not a vertex itself. Movers are numbered: the vertices, then these.
  struct InnerRow {
    std::int32_t row;
    std::int32_t surface;
  };
  [[nodiscard]] const std::vector<InnerRow>& inner_rows() const { return inner_rows_; }
  [[nodiscard]] std::size_t mover_count() const { return vertices_.size() + inner_rows_.size(); }
  /// The vertices that a mover carries, with its weight.
  struct Carried {
    std::int32_t vertex;
    double weight;
  };
  [[nodiscard]] std::span<const Carried> carried_by(std::int32_t mover) const;
  /// Whether a vertex is one of these nodes of its body, ascending, or all that carry it are.
  [[nodiscard]] bool is_among(const std::vector<std::int32_t>& nodes, std::int32_t vertex) const;
  /// Of vertices that rows carry: the same place of material that no cut parted carries both sides of a pair.
  [[nodiscard]] bool is_joined(std::span<const std::int32_t> first,
                               std::span<const std::int32_t> second) const;
  /// One row carries both sides of a pair of two surfaces, which are one material there.
  [[nodiscard]] bool is_of_one_row(std::span<const std::int32_t> first,
                                   std::span<const std::int32_t> second) const;
  /// Where riders are, of the places of all movers, three numbers each, and the rotations of a state.
  void place_riders(Reals places, std::span<const Quaternion> rotations) const;

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
  // flat_edges.cpp
  /// Marks the edges and vertices inside planes of the latest surface, which is rigid.
  void mark_flat(std::int32_t first_primitive, std::int32_t first_edge);
  void mark_flat_vertices(std::int32_t first_vertex, std::int32_t first_edge);
  // surface_riders.cpp
  /// A vertex of the latest body that nodes carry; its place at rest.
  Vec3 ride(const SurfaceRiders& riders, std::size_t number, std::int32_t first_row, SurfaceVertex& vertex,
            ConstReals rest);
  [[nodiscard]] std::int32_t surface_of_mover(std::int32_t mover) const;
  // turning_riders.cpp
  /// Notes the frames of the rows that carry riders, whose arms are there.
  void find_frames(std::span<const Frame> frames);
  void find_rollers(const ContactDescription& description, std::span<const Frame> frames);
  void list_rotations();
  void list_movers(const ContactDescription& description, std::span<const std::int32_t> first_node);
  void list_carried();

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
  std::vector<RiderPart> rider_part_;
  std::vector<RiderTurn> rider_turn_;  ///< beside them; empty: no rotation carries any
  std::vector<Roller> rollers_;
  std::vector<SurfaceRotation> rotations_;
  bool has_shared_rows_ = false;  ///< a row carries vertices of two surfaces
  std::vector<std::int32_t> rider_begin_ = {0};
  std::vector<InnerRow> inner_rows_;
  std::vector<std::int32_t> root_;  ///< of each mover: rows that are copies of one node have one
  std::vector<Carried> carried_;
  std::vector<std::int32_t> carried_begin_;  ///< of each mover, and the end; empty: no riders
};

}  // namespace tissu
