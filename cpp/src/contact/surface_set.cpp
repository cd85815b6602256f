#include "tissu/contact/surface_set.h"

#include <algorithm>

#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

/// Finds edges by their ends: those at each lower end are a list.
class EdgeLists {
 public:
  EdgeLists(std::int32_t first_vertex, std::size_t vertices)
      : first_vertex_(first_vertex), latest_(vertices - at(first_vertex), -1) {}

  /// The edge between two vertices; `next`, which is new, where there is none.
  std::int32_t find(std::int32_t a, std::int32_t b, std::int32_t next) {
    const auto [low, high] = std::minmax(a, b);
    std::int32_t& latest = latest_[at(low - first_vertex_)];
    for (std::int32_t i = latest; i >= 0; i = edges_[at(i)].before) {
      if (edges_[at(i)].high == high) return edges_[at(i)].number;
    }
    edges_.push_back({high, next, latest});
    latest = static_cast<std::int32_t>(edges_.size()) - 1;
    return next;
  }

 private:
  struct Edge {
    std::int32_t high;
    std::int32_t number;
    std::int32_t before;  ///< in the list
  };
  std::int32_t first_vertex_;
  std::vector<std::int32_t> latest_;  ///< of each vertex
  std::vector<Edge> edges_;
};

/// The nodes of the primitives, ascending, and their places in this list.
class NodeNumbers {
 public:
  explicit NodeNumbers(const SurfaceDescription& description) {
    for (const auto& t : description.triangles) nodes_.insert(nodes_.end(), t.begin(), t.end());
    for (const auto& e : description.edges) nodes_.insert(nodes_.end(), e.begin(), e.end());
    nodes_.insert(nodes_.end(), description.points.begin(), description.points.end());
    if (nodes_.empty()) return;
    const auto [low, high] = std::ranges::minmax(nodes_);
    low_ = low;
    place_.assign(at(high - low) + 1, -1);
    for (const std::int32_t node : nodes_) place_[at(node - low)] = 0;
    nodes_.clear();
    for (std::size_t i = 0; i < place_.size(); ++i) {
      if (place_[i] < 0) continue;
      place_[i] = static_cast<std::int32_t>(nodes_.size());
      nodes_.push_back(low + static_cast<std::int32_t>(i));
    }
  }
  [[nodiscard]] const std::vector<std::int32_t>& all() const { return nodes_; }
  [[nodiscard]] std::int32_t operator[](std::int32_t node) const { return place_[at(node - low_)]; }

 private:
  std::vector<std::int32_t> nodes_;
  std::int32_t low_ = 0;
  std::vector<std::int32_t> place_;
};

/// Lists `items` by the bin of each: those of bin b stand at [begin[b], begin[b + 1]).
void list_by(const std::vector<std::int32_t>& bin, std::size_t bins, std::vector<std::int32_t>& begin,
             std::vector<std::int32_t>& items) {
  begin.assign(bins + 1, 0);
  for (const std::int32_t b : bin) ++begin[at(b) + 1];
  for (std::size_t b = 0; b < bins; ++b) begin[b + 1] += begin[b];
  std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
  items.resize(bin.size());
  for (std::size_t i = 0; i < bin.size(); ++i) {
    items[at(next[at(bin[i])]++)] = static_cast<std::int32_t>(i);
  }
}

std::span<const std::int32_t> listed(const std::vector<std::int32_t>& begin,
                                     const std::vector<std::int32_t>& items, std::int32_t bin) {
  return std::span(items).subspan(at(begin[at(bin)]), at(begin[at(bin) + 1] - begin[at(bin)]));
}

}  // namespace

SurfaceSet::SurfaceSet(const ContactDescription& description, std::span<const std::int32_t> first_node,
                       ConstReals rest, std::span<const Frame> frames) {
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    add(description.bodies[i], first_node[i], -1, rest);
  }
  if (has_turning_riders()) find_frames(frames);
  find_rollers(description, frames);
  // Of augmented contacts vertices inside a plane stay: they hold what lies on them with more points, and
  // push along the normal of a face. A barrier would push along the distance, which is not the plane's normal
  // where the face that lies on it is bent.
  const bool planes_alone = description.method != ContactMethod::augmented;
  for (std::size_t i = 0; i < description.obstacles.size(); ++i) {
    const ObstacleDescription& obstacle = description.obstacles[i];
    const auto first_vertex = static_cast<std::int32_t>(vertices_.size());
    const auto first_edge = static_cast<std::int32_t>(edges_.size());
    add(obstacle.surface, -1, static_cast<std::int32_t>(i), rest);
    if (planes_alone) mark_flat_vertices(first_vertex, first_edge);
    if (obstacle.frame >= 0) carry(frames[at(obstacle.frame)], obstacle.frame, obstacle.origin);
  }
  list_by(owner_, primitives_.size(), own_vertex_begin_, own_vertex_);
  std::vector<std::int32_t> edge_owner(edges_.size());
  for (std::size_t p = primitives_.size(); p-- > 0;) {
    for (const std::int32_t e : triangle_edges_[p]) {
      if (e >= 0) edge_owner[at(e)] = static_cast<std::int32_t>(p);
    }
  }
  list_by(edge_owner, primitives_.size(), own_edge_begin_, own_edge_);
  list_neighbours();
  if (has_riders()) list_movers(description, first_node);
  list_rotations();
}

/// Vertices are those that a primitive has, in the order of the nodes.
void SurfaceSet::add(const SurfaceDescription& description, std::int32_t first_row, std::int32_t obstacle,
                     ConstReals rest) {
  const auto surface = static_cast<std::int32_t>(surfaces_.size());
  const auto first_vertex = static_cast<std::int32_t>(vertices_.size());
  const auto first_primitive = static_cast<std::int32_t>(primitives_.size());
  const auto first_edge = static_cast<std::int32_t>(edges_.size());
  const NodeNumbers nodes(description);
  const auto number = [&](std::int32_t node) { return first_vertex + nodes[node]; };
  const std::vector<std::int32_t>& riders = description.riders.vertex;
  auto found = riders.begin();  // they ascend, as the nodes do
  for (const std::int32_t node : nodes.all()) {
    SurfaceVertex vertex;
    vertex.node = node;
    vertex.surface = surface;
    if (!description.radius.empty() && node >= 0) vertex.radius = description.radius[at(node)];
    Vec3 place;
    while (found != riders.end() && *found < node) ++found;
    if (found != riders.end() && *found == node) {
      const auto number = static_cast<std::size_t>(found - riders.begin());
      place = ride(description.riders, number, first_row, vertex, rest);
      if (node < 0 && !description.radius.empty()) {
        const auto carriers =
            std::span(description.riders.node)
                .subspan(at(description.riders.begin[number]),
                         at(description.riders.begin[number + 1] - description.riders.begin[number]));
        for (const std::int32_t carrier : carriers)
          vertex.radius = std::max(vertex.radius, description.radius[at(carrier)]);
      }
    } else if (obstacle < 0) {
      vertex.row = first_row + node;
      place = block(rest, vertex.row);
    } else {
      place = block(ConstReals(description.vertices), node);
    }
    vertices_.push_back(vertex);
    rest_.insert(rest_.end(), place.begin(), place.end());
  }
  for (const auto& t : description.triangles) {
    primitives_.push_back({{number(t[0]), number(t[1]), number(t[2])}, 3});
  }
  for (const auto& e : description.edges) primitives_.push_back({{number(e[0]), number(e[1]), -1}, 2});
  for (const std::int32_t p : description.points) primitives_.push_back({{number(p), -1, -1}, 1});
  const std::vector<std::int32_t> crowded = add_edges(first_primitive, first_vertex);
  if (description.closed) part_wedges(crowded, first_primitive, first_edge);
  measure(first_primitive, first_edge);
  if (obstacle >= 0) mark_flat(first_primitive, first_edge);
  surfaces_.push_back({description.name, first_vertex, static_cast<std::int32_t>(vertices_.size()),
                       description.closed, obstacle, -1, first_row});
  first_primitive_.push_back(static_cast<std::int32_t>(primitives_.size()));
}

void SurfaceSet::carry(const Frame& frame, std::int32_t number, const Vec3& origin) {
  if (carriers_.empty()) first_carried_ = surfaces_.back().first_vertex;
  arms_.resize(vertices_.size() - at(first_carried_), Vec3::Zero());
  for (std::int32_t v = surfaces_.back().first_vertex; v < surfaces_.back().last_vertex; ++v) {
    vertices_[at(v)].carrier = static_cast<std::int32_t>(carriers_.size());
    arms_[at(v - first_carried_)] = Vec3(block(ConstReals(rest_), v)) - origin;
  }
  surfaces_.back().carrier = static_cast<std::int32_t>(carriers_.size());
  carriers_.push_back({number, frame.block, frame.rotation});
}

/// The edges that have more than two triangles, ascending.
std::vector<std::int32_t> SurfaceSet::add_edges(std::int32_t first_primitive, std::int32_t first_vertex) {
  std::vector<std::int32_t> crowded;
  EdgeLists known(first_vertex, vertices_.size());
  owner_.resize(vertices_.size(), -1);
  for (std::size_t v = at(first_vertex); v < vertices_.size(); ++v) vertices_[v].is_lone = true;
  triangle_edges_.resize(primitives_.size(), {-1, -1, -1});
  for (auto p = first_primitive; p < static_cast<std::int32_t>(primitives_.size()); ++p) {
    const Primitive& primitive = primitives_[at(p)];
    for (int i = 0; i < primitive.corners; ++i) {
      std::int32_t& owner = owner_[at(primitive.vertex[at(i)])];
      if (owner < 0) owner = p;
    }
    for (int i = 0; i < (primitive.corners == 3 ? 3 : primitive.corners - 1); ++i) {
      const std::int32_t a = primitive.vertex[at(i)];
      const std::int32_t b = primitive.vertex[at((i + 1) % 3)];
      const auto next = static_cast<std::int32_t>(edges_.size());
      const std::int32_t number = known.find(a, b, next);
      if (number == next) edges_.push_back({{a, b}});
      triangle_edges_[at(p)][at(i)] = number;
      vertices_[at(a)].is_lone = vertices_[at(b)].is_lone = false;
      if (primitive.corners < 3) continue;
      vertices_[at(a)].has_faces = vertices_[at(b)].has_faces = true;
      SurfaceEdge& edge = edges_[at(number)];
      const std::size_t side = edge.face[0] < 0 ? 0 : 1;
      if (edge.face[side] >= 0) {  // a third triangle beside an edge
        crowded.push_back(number);
        continue;
      }
      edge.face[side] = p;
      edge.across[side] = primitive.vertex[at((i + 2) % 3)];
    }
  }
  sort_unique(crowded);
  return crowded;
}

void SurfaceSet::measure(std::int32_t first_primitive, std::int32_t first_edge) {
  double sum = 0.0;
  for (std::size_t e = at(first_edge); e < edges_.size(); ++e) {
    const auto& [a, b] = edges_[e].vertex;
    edges_[e].length = (block(ConstReals(rest_), a) - block(ConstReals(rest_), b)).norm();
    sum += edges_[e].length;
  }
  const std::size_t count = edges_.size() - at(first_edge);
  mean_edge_.push_back(count == 0 ? 0.0 : sum / static_cast<double>(count));
  for (std::size_t p = at(first_primitive); p < primitives_.size(); ++p) {
    if (primitives_[p].corners < 3) continue;
    const auto& [a, b, c] = primitives_[p].vertex;
    const Vec3 x = block(ConstReals(rest_), a);
    const double area = 0.5 * (block(ConstReals(rest_), b) - x).cross(block(ConstReals(rest_), c) - x).norm();
    for (const std::int32_t v : {a, b, c}) vertices_[at(v)].area += area / 3.0;
  }
}

void SurfaceSet::list_neighbours() {
  neighbour_begin_.assign(vertices_.size() + 1, 0);
  for (const SurfaceEdge& edge : edges_) {
    for (const std::int32_t v : edge.vertex) ++neighbour_begin_[at(v) + 1];
  }
  for (std::size_t v = 0; v < vertices_.size(); ++v) neighbour_begin_[v + 1] += neighbour_begin_[v];
  neighbour_.resize(at(neighbour_begin_.back()));
  std::vector<std::int32_t> next(neighbour_begin_.begin(), neighbour_begin_.end() - 1);
  for (const SurfaceEdge& edge : edges_) {
    neighbour_[at(next[at(edge.vertex[0])]++)] = edge.vertex[1];
    neighbour_[at(next[at(edge.vertex[1])]++)] = edge.vertex[0];
  }
}

std::span<const std::int32_t> SurfaceSet::vertices_of(std::int32_t primitive) const {
  return listed(own_vertex_begin_, own_vertex_, primitive);
}

std::span<const std::int32_t> SurfaceSet::edges_of(std::int32_t primitive) const {
  return listed(own_edge_begin_, own_edge_, primitive);
}

std::span<const std::int32_t> SurfaceSet::neighbours(std::int32_t vertex) const {
  return std::span(neighbour_)
      .subspan(at(neighbour_begin_[at(vertex)]),
               at(neighbour_begin_[at(vertex) + 1] - neighbour_begin_[at(vertex)]));
}

std::int32_t SurfaceSet::surface_of_primitive(std::int32_t primitive) const {
  return vertices_[at(primitives_[at(primitive)].vertex[0])].surface;
}

std::size_t SurfaceSet::bytes() const {
  const auto of = [](const auto& list) { return list.size() * sizeof(list[0]); };
  return of(vertices_) + of(edges_) + of(primitives_) + of(triangle_edges_) + of(rest_) + of(owner_) +
         of(own_vertex_) + of(own_edge_) + of(own_vertex_begin_) + of(own_edge_begin_) + of(neighbour_) +
         of(neighbour_begin_) + of(carriers_) + of(arms_) + of(rollers_) + of(rider_part_) + of(rider_turn_) +
         of(rider_begin_) + of(rotations_) + of(inner_rows_) + of(root_) + of(carried_) + of(carried_begin_);
}

}  // namespace tissu
