#include "left_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <unordered_map>

#include "tissu/base/sort_unique.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

using Nodes = std::vector<std::int32_t>;

constexpr double kRoundOff = 1e-9;  ///< of a face: that so much of it is missing means nothing

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The corners of a face of this type.
std::size_t corners_of(const ElementInfo& element) {
  if (element.dimension == 1) return 2;
  return element.name.starts_with("triangle") ? 3 : 4;
}

/// Of a triangle its area, of an edge its length.
double measure(std::span<const Vec3> p) {
  if (p.size() == 2) return (p[1] - p[0]).norm();
  return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
}

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

  std::vector<double> find() {
    for (const std::int32_t cell : cells_near()) look_at(cell);
    std::vector<double> shares;
    shares.reserve(faces_.size());
    for (const Face& face : faces_) {
      const double share = face.left / face.whole;
      const bool is_whole = share > 1.0 - kRoundOff || (cut_.hosts.moved() && share > 0.0);
      shares.push_back(is_whole ? 1.0 : share);
    }
    return shares;
  }

 private:
  struct Face {
    Nodes corners;
    double whole;
    double left = 0.0;
    /// Vertices of the smallest part of it: those of an edge or of a triangle.
    [[nodiscard]] std::size_t least() const { return std::min<std::size_t>(corners.size(), 3); }
  };

  void add(const Nodes& corners) {
    const auto number = static_cast<std::int32_t>(faces_.size());
    for (const std::int32_t node : corners) faces_at_[node].push_back(number);
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

  void look_at(std::int32_t cell) {
    const Nodes candidates = candidates_of(cell);
    if (candidates.empty()) return;
    for (const MaterialTetra& part : material_of(cut_.hosts, cut_.material, cell)) {
      const auto vertices = std::span(part.vertices).first(part.corners());
      for (const std::int32_t number : candidates) {
        Face& face = faces_[at(number)];
        if (vertices.size() == face.least()) take(face, {vertices.begin(), vertices.end()});
        if (vertices.size() != face.least() + 1) continue;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
          if ((part.cut >> i & 1U) != 0) continue;
          Nodes others;
          others.reserve(vertices.size());
          for (std::size_t j = 0; j < vertices.size(); ++j) {
            if (j != i) others.push_back(vertices[j]);
          }
          take(face, std::move(others));
        }
      }
    }
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

  /// Faces that the cell may have a part of: enough of their corners are among the nodes of the first day
  /// between which its own lie.
  [[nodiscard]] Nodes candidates_of(std::int32_t cell) const {
    Nodes around;
    for (const std::int32_t node : cut_.hosts.corners(cell)) {
      const Rider origin = cut_.hosts.on_first_day({{node, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1});
      around.insert(around.end(), origin.node.begin(), origin.node.begin() + origin.count);
    }
    sort_unique(around);
    Nodes near;
    for (const std::int32_t node : around) {
      const auto found = faces_at_.find(node);
      if (found != faces_at_.end()) near.insert(near.end(), found->second.begin(), found->second.end());
    }
    std::ranges::sort(near);
    Nodes candidates;
    for (auto first = near.begin(); first != near.end();) {
      const auto last = std::find_if(first, near.end(), [&](std::int32_t one) { return one != *first; });
      if (static_cast<std::size_t>(last - first) >= faces_[at(*first)].least()) candidates.push_back(*first);
      first = last;
    }
    return candidates;
  }

  /// A triangle or an edge of the material, if it lies in the face; one that a volume and a sheet have, once.
  void take(Face& face, Nodes vertices) {
    std::vector<Vec3> p;
    for (const std::int32_t vertex : vertices) {
      if (!lies_in(vertex, face.corners)) return;
      p.push_back(cut_.material.at(vertex, cut_.hosts.rest()));
    }
    std::ranges::sort(vertices);
    if (taken_.insert(std::move(vertices)).second) face.left += measure(p);
  }

  [[nodiscard]] bool lies_in(std::int32_t vertex, const Nodes& corners) const {
    const Rider own = vertex < 0 ? cut_.material.riders[at(-1 - vertex)]
                                 : Rider{{vertex, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1};
    const Rider origin = cut_.hosts.on_first_day(own);
    for (std::size_t k = 0; k < at(origin.count); ++k) {
      if (origin.weight[k] != 0.0 && std::ranges::find(corners, origin.node[k]) == corners.end())
        return false;
    }
    return origin.count > 0;
  }

  const CutState& cut_;
  std::vector<Face> faces_;
  std::unordered_map<std::int32_t, Nodes> faces_at_;  ///< by each of their corners
  std::set<Nodes> taken_;                             ///< vertices, ascending
};

}  // namespace

std::vector<double> shares_left(const CutState& cut, const std::vector<FaceCells>& faces) {
  return LeftFaces(cut, faces).find();
}

}  // namespace tissu
