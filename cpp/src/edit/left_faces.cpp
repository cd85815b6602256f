#include "left_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/element/reference_cell.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

using Nodes = std::vector<std::int32_t>;

constexpr double kRoundOff = 1e-9;  ///< of a face: that so much of it is missing means nothing

/// The corners of a face of this type.
std::size_t corners_of(const ElementInfo& element) {
  if (element.dimension == 1) return 2;
  return element.name.starts_with("triangle") ? 3 : 4;
}

/// The type of a face of this dimension.
std::string_view face_type(int dimension, std::size_t nodes) {
  const auto all = elements();
  return std::ranges::find_if(
             all,
             [&](const ElementInfo& one) { return one.dimension == dimension && at(one.nodes) == nodes; })
      ->name;
}

/// Of a triangle its area, of an edge its length.
double measure(std::span<const Vec3> p) {
  if (p.size() == 2) return (p[1] - p[0]).norm();
  return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
}

/// A face of a cell that a load may act on: of a volume, of a sheet itself, of a flat body an edge.
struct CellFace {
  int dimension;
  std::size_t corners;
  Nodes nodes;  ///< the corners first
};

class LeftFaces {
 public:
  LeftFaces(const CutState& cut, const std::vector<FaceCells>& faces) : cut_(cut) {
    for (const FaceCells& some : faces) {
      const ElementInfo& element = *find_element(some.element);
      const auto nodes = at(element.nodes);
      for (std::size_t i = 0; i + nodes <= some.nodes.size(); i += nodes) {
        const auto first = some.nodes.begin() + static_cast<std::ptrdiff_t>(i);
        add({first, first + static_cast<std::ptrdiff_t>(corners_of(element))});
      }
    }
  }

  std::vector<FaceLeft> find() {
    const Nodes cells = cells_near();
    for (const bool solid : {true, false}) {
      for (const std::int32_t cell : cells) {
        if ((info(cut_.hosts.type(cell)).dimension == 3) == solid) look_at(cell);
      }
    }
    std::vector<FaceLeft> all;
    all.reserve(faces_.size());
    for (Face& face : faces_) {
      FaceLeft& left = all.emplace_back(FaceLeft{face.left / face.whole, std::move(face.parts)});
      if (left.share > 1.0 - kRoundOff || (cut_.hosts.moved() && left.share > 0.0)) left.share = 1.0;
    }
    return all;
  }

 private:
  struct Face {
    Nodes corners;
    double whole;
    double left = 0.0;
    std::vector<FacePart> parts = {};
  };

  void add(const Nodes& corners) {
    const auto number = static_cast<std::int32_t>(faces_.size());
    for (const std::int32_t node : corners) faces_at_[node].push_back(number);
    has_edges_ = has_edges_ || corners.size() == 2;
    faces_.push_back({corners, whole(corners)});
  }

  /// A quad is cut at its lowest node, as the material of its cell is.
  [[nodiscard]] double whole(const Nodes& corners) const {
    std::vector<Vec3> p;
    p.reserve(corners.size());
    const auto low = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
    for (std::size_t i = 0; i < corners.size(); ++i)
      p.emplace_back(block(cut_.hosts.rest(), corners[(low + i) % corners.size()]));
    if (p.size() < 4) return measure(p);
    return measure(std::array{p[0], p[1], p[2]}) + measure(std::array{p[0], p[2], p[3]});
  }

  /// The cells at nodes that are copies of corners of the faces, or lie between such.
  [[nodiscard]] Nodes cells_near() const {
    std::vector<char> is_corner(at(cut_.hosts.node_count()), 0);
    for (const auto& [node, faces] : faces_at_) is_corner[at(node)] = 1;
    Nodes cells;
    for (std::int32_t node = 0; node < cut_.hosts.node_count(); ++node) {
      const std::int32_t root = cut_.hosts.root(node);
      if (root >= 0 && is_corner[at(root)] == 0) continue;
      const auto own = cut_.hosts.cells_at(node);
      cells.insert(cells.end(), own.begin(), own.end());
    }
    sort_unique(cells);
    return cells;
  }

  void look_at(std::int32_t cell) {
    std::vector<MaterialTetra> material;
    for (const CellFace& own : faces_of(cell)) {
      const std::int32_t number = face_with(own);
      if (number < 0) continue;
      if (material.empty()) material = material_of(cut_.hosts, cut_.material, cell);
      take(own, material, faces_[at(number)]);
    }
  }

  [[nodiscard]] std::vector<CellFace> faces_of(std::int32_t cell) const {
    const auto nodes = cut_.hosts.nodes(cell);
    const CellType type = cut_.hosts.type(cell);
    const std::size_t corners = cut_.hosts.corners(cell).size();
    std::vector<CellFace> all;
    if (info(type).dimension == 2) {
      all.push_back({2, corners, {nodes.begin(), nodes.end()}});
      if (!has_edges_) return all;
      const auto ends = edges(type);
      for (std::size_t i = 0; i < ends.size(); ++i) {
        CellFace& edge = all.emplace_back(CellFace{1, 2, {nodes[ends[i][0]], nodes[ends[i][1]]}});
        if (corners + i < nodes.size()) edge.nodes.push_back(nodes[corners + i]);
      }
    }
    for (const LocalFace& face : faces(type)) {
      CellFace& own = all.emplace_back(CellFace{2, at(face.corners), {}});
      for (std::size_t i = 0; i < at(face.nodes); ++i) own.nodes.push_back(nodes[face.node[i]]);
    }
    return all;
  }

  /// The face of the first day in which a face of a cell lies; -1: in none. Of several it is that with as
  /// many corners.
  [[nodiscard]] std::int32_t face_with(const CellFace& own) const {
    Nodes origins;
    for (std::size_t i = 0; i < own.corners; ++i) {
      const Rider origin = cut_.hosts.on_first_day({{own.nodes[i], -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1});
      if (origin.count == 0) return -1;
      for (std::size_t k = 0; k < at(origin.count); ++k) {
        if (origin.weight[k] == 0.0) continue;
        if (!faces_at_.contains(origin.node[k])) return -1;
        origins.push_back(origin.node[k]);
      }
    }
    std::int32_t best = -1;
    for (const std::int32_t number : faces_at_.at(origins.front())) {
      const Nodes& corners = faces_[at(number)].corners;
      const bool is_edge = corners.size() == 2;
      const auto is_in = [&](std::int32_t node) { return std::ranges::find(corners, node) != corners.end(); };
      if (is_edge != (own.dimension == 1) || !std::ranges::all_of(origins, is_in)) continue;
      if (best < 0 || corners.size() == own.corners) best = number;
    }
    return best;
  }

  /// Takes the triangles or edges of the material of a cell that lie in a face of it; one that a volume and a
  /// sheet have, once.
  void take(const CellFace& own, const std::vector<MaterialTetra>& material, Face& face) {
    FacePart part{face_type(own.dimension, own.nodes.size()), own.nodes, {}};
    const std::vector<ReferencePoint> corners = reference_nodes(part.element);
    double taken = 0.0;
    const auto take_one = [&](Nodes vertices) {
      std::vector<Vec3> p;
      std::vector<ReferencePoint> piece;
      for (const std::int32_t vertex : vertices) {
        ReferencePoint& local = piece.emplace_back();
        if (!locate(vertex, own, corners, local)) return;
        p.push_back(cut_.material.at(vertex, cut_.hosts.rest()));
      }
      std::ranges::sort(vertices);
      if (!taken_.insert(std::move(vertices)).second) return;
      face.left += measure(p);
      taken += reference_measure(piece);
      part.pieces.push_back(std::move(piece));
    };
    for (const MaterialTetra& tetra : material) {
      const auto vertices = std::span(tetra.vertices).first(tetra.corners());
      if (at(own.dimension) + 1 == vertices.size()) take_one({vertices.begin(), vertices.end()});
      if (at(own.dimension) + 2 != vertices.size()) continue;
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        if ((tetra.cut >> i & 1U) != 0) continue;
        Nodes others;
        for (std::size_t j = 0; j < vertices.size(); ++j) {
          if (j != i) others.push_back(vertices[j]);
        }
        take_one(std::move(others));
      }
    }
    if (part.pieces.empty()) return;
    if (taken > (1.0 - kRoundOff) * whole_reference(own)) part.pieces.clear();
    face.parts.push_back(std::move(part));
  }

  static double whole_reference(const CellFace& own) {
    if (own.dimension == 1) return 2.0;
    return own.corners == 3 ? 0.5 : 4.0;
  }

  /// Where a vertex is in a face of its cell; false: beside it.
  bool locate(std::int32_t vertex, const CellFace& own, const std::vector<ReferencePoint>& corners,
              ReferencePoint& local) const {
    const Rider rider = vertex < 0 ? cut_.material.riders[at(-1 - vertex)]
                                   : Rider{{vertex, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1};
    for (std::size_t k = 0; k < at(rider.count); ++k) {
      if (rider.weight[k] == 0.0) continue;
      const auto end = own.nodes.begin() + static_cast<std::ptrdiff_t>(own.corners);
      const auto corner = std::find(own.nodes.begin(), end, rider.node[k]);
      if (corner == end) return false;
      const ReferencePoint& place = corners[static_cast<std::size_t>(corner - own.nodes.begin())];
      for (std::size_t i = 0; i < place.size(); ++i) local[i] += rider.weight[k] * place[i];
    }
    return rider.count > 0;
  }

  const CutState& cut_;
  std::vector<Face> faces_;
  bool has_edges_ = false;
  std::unordered_map<std::int32_t, Nodes> faces_at_;  ///< by each of their corners
  std::set<Nodes> taken_;                             ///< vertices, ascending
};

}  // namespace

std::vector<FaceLeft> faces_left(const CutState& cut, const std::vector<FaceCells>& faces) {
  return LeftFaces(cut, faces).find();
}

}  // namespace tissu
