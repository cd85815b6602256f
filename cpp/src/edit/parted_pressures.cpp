#include "parted_pressures.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string>

#include "edit/cut/patch.h"
#include "left_faces.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/edit/cut_state.h"
#include "tissu/element/reference_cell.h"
#include "tissu/element/reference_part.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

using Nodes = std::vector<std::int32_t>;
using Triangle = std::array<std::int32_t, 3>;  ///< vertices of the material

constexpr double kRoundOff = 1e-12;     ///< of a face: that so much of it is missing means nothing
constexpr double kReferenceArea = 4.0;  ///< of a quad

Nodes sorted(Nodes nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

/// Whether two orders of the same nodes run the same way around.
bool same_way(const Nodes& a, const Nodes& b) {
  const auto start = static_cast<std::size_t>(std::ranges::find(b, a.front()) - b.begin());
  return b[(start + 1) % b.size()] == a[1];
}

/// The faces of a body that a pressure acts on, as they are after cuts.
class Pressed {
 public:
  Pressed(const CutState& cut, const std::vector<FaceCells>& first_day)
      : cut_(cut), pressed_(at(cut.hosts.node_count()), 0) {
    for (const FaceCells& some : first_day) {
      const auto corners = at(find_element(some.element)->nodes);
      for (std::size_t i = 0; i + corners <= some.nodes.size(); i += corners) {
        const auto first = some.nodes.begin() + static_cast<std::ptrdiff_t>(i);
        Nodes face(first, first + static_cast<std::ptrdiff_t>(corners));
        for (const std::int32_t node : face) {
          faces_at_[node].push_back(face);
          pressed_[at(node)] = 1;
        }
        faces_.emplace(sorted(face), face);
      }
    }
  }

  void find(PressureDescription& pressure) {
    for (const bool solid : {true, false}) {
      for (const std::int32_t cell : cut_.hosts.numbers()) {
        if ((info(cut_.hosts.type(cell)).dimension == 3) == solid && may_have(cell)) look_at(cell);
      }
    }
    pressure.faces.clear();
    if (!triangles_.empty()) pressure.faces.push_back({"triangle", std::move(triangles_)});
    if (!quads_.empty()) pressure.faces.push_back({"quad", std::move(quads_)});
    pressure.carried = std::move(carried_);
    pressure.parts = std::move(parts_);
  }

 private:
  /// A face has three nodes at least, which come from nodes of faces of the first day.
  [[nodiscard]] bool may_have(std::int32_t cell) const {
    return std::ranges::count_if(cut_.hosts.corners(cell), [&](std::int32_t node) {
             const std::int32_t root = cut_.hosts.root(node);
             return root < 0 || pressed_[at(root)] != 0;
           }) >= 3;
  }

  void look_at(std::int32_t cell) {
    const auto corners = cut_.hosts.corners(cell);
    if (info(cut_.hosts.type(cell)).dimension == 1) return;
    if (info(cut_.hosts.type(cell)).dimension == 2) {
      look_at(cell, {corners.begin(), corners.end()});
      return;
    }
    for (const LocalFace& face : faces(cut_.hosts.type(cell))) {
      Nodes nodes;
      for (std::size_t c = 0; c < at(face.corners); ++c) nodes.push_back(corners[face.node[c]]);
      look_at(cell, nodes);
    }
  }

  /// `nodes`: of a face of the cell, anticlockwise seen from outside; of a sheet all.
  void look_at(std::int32_t cell, const Nodes& nodes) {
    Nodes roots;
    for (const std::int32_t node : nodes) roots.push_back(cut_.hosts.root(node));
    if (std::ranges::any_of(roots, [](std::int32_t root) { return root < 0; })) {
      look_at_part(nodes);
      return;
    }
    const auto pressed = faces_.find(sorted(roots));
    if (pressed == faces_.end()) return;
    const bool same = same_way(roots, pressed->second);
    const auto stored = cut_.material.cells.find(cell);
    if (stored != cut_.material.cells.end()) {
      const std::vector<Triangle> own = own_triangles(stored->second, nodes);
      if (nodes.size() == 3) {
        carry(own, same);
      } else {
        take_quad(own, nodes, same);
      }
      return;
    }
    add_face(nodes, same);
  }

  /// A triangle of a divided cell, some nodes of which a cut put between those of the first day.
  void look_at_part(const Nodes& nodes) {
    std::array<Rider, 3> riders;
    Nodes all;
    for (std::size_t i = 0; i < riders.size(); ++i) {
      riders[i] = origin_of(nodes[i]);
      if (riders[i].count == 0) return;  // on an edge that a repair made inside
      for (std::size_t k = 0; k < at(riders[i].count); ++k) {
        if (riders[i].weight[k] != 0.0) all.push_back(riders[i].node[k]);
      }
    }
    sort_unique(all);
    const auto faces = faces_at_.find(all.front());
    if (faces == faces_at_.end()) return;
    for (const Nodes& face : faces->second) {
      if (face.size() != 3 || !std::ranges::includes(sorted(face), all)) continue;
      Mat3 shares = Mat3::Zero();
      for (std::size_t i = 0; i < riders.size(); ++i) {
        for (std::size_t k = 0; k < at(riders[i].count); ++k) {
          const auto corner = std::ranges::find(face, riders[i].node[k]) - face.begin();
          if (corner < 3) shares(static_cast<Eigen::Index>(i), corner) += riders[i].weight[k];
        }
      }
      add_face(nodes, shares.determinant() > 0.0);
      return;
    }
  }

  /// Between which nodes of the first day a node lies.
  [[nodiscard]] Rider origin_of(std::int32_t node) const {
    const std::int32_t root = cut_.hosts.root(node);
    if (root < 0) return cut_.hosts.points()[at(-1 - root)];
    return {{root, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1};
  }

  /// `same`: the nodes run the way around that the pressure acts by.
  void add_face(const Nodes& nodes, bool same) {
    if (!is_new(nodes)) return;
    Nodes& list = nodes.size() == 3 ? triangles_ : quads_;
    if (same) {
      list.insert(list.end(), nodes.begin(), nodes.end());
    } else {
      list.insert(list.end(), nodes.rbegin(), nodes.rend());
    }
  }

  /// The faces of tetrahedra that lie in a face of their host, and triangles of a sheet itself, but for those
  /// that have the pressure already.
  std::vector<Triangle> own_triangles(const std::vector<MaterialTetra>& material, const Nodes& nodes) {
    std::vector<Triangle> own;
    const auto take = [&](const Triangle& vertices) {
      if (taken_.insert(ascending(vertices)).second) own.push_back(vertices);
    };
    for (const MaterialTetra& tetra : material) {
      const auto& v = tetra.vertices;
      if (tetra.corners() == 3) {
        take({v[0], v[1], v[2]});
        continue;
      }
      for (std::size_t f = 0; f < 4; ++f) {
        const auto& [a, b, c] = kOpposite[f];
        const bool inside = std::ranges::all_of(Triangle{v[a], v[b], v[c]},
                                                [&](std::int32_t vertex) { return lies_in(vertex, nodes); });
        if (inside && (tetra.cut >> f & 1U) == 0) take({v[a], v[b], v[c]});
      }
    }
    return own;
  }

  static Triangle ascending(Triangle vertices) {
    std::ranges::sort(vertices);
    return vertices;
  }

  /// Whether no volume presses there: a sheet on one of its faces has the same face once more, a quad in the
  /// halves into which the volume cuts it.
  bool is_new(const Nodes& nodes) {
    const auto root = [&](std::int32_t node) { return cut_.hosts.root(node); };
    const auto low = static_cast<std::size_t>(std::ranges::min_element(nodes, {}, root) - nodes.begin());
    bool all = true;
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
      const auto node = [&](std::size_t k) { return nodes[(low + k) % nodes.size()]; };
      all = taken_.insert(ascending({node(0), node(i), node(i + 1)})).second && all;
    }
    return all;
  }

  [[nodiscard]] Rider rider_of(std::int32_t vertex) const {
    if (vertex >= 0) return {{vertex, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1};
    return cut_.material.riders[at(-1 - vertex)];
  }

  [[nodiscard]] bool lies_in(std::int32_t vertex, const Nodes& nodes) const {
    const Rider rider = rider_of(vertex);
    for (std::size_t k = 0; k < at(rider.count); ++k) {
      if (rider.weight[k] != 0.0 && std::ranges::find(nodes, rider.node[k]) == nodes.end()) return false;
    }
    return true;
  }

  void carry(const std::vector<Triangle>& own, bool same) {
    for (Triangle vertices : own) {
      if (!same) std::swap(vertices[1], vertices[2]);
      CarriedFace& face = carried_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Rider rider = rider_of(vertices[i]);
        for (std::size_t k = 0; k < at(rider.count); ++k) {
          if (rider.weight[k] != 0.0) face[i].push_back({rider.node[k], rider.weight[k]});
        }
      }
    }
  }

  /// A quad is not flat once it is bent, and two triangles would load its nodes by other shares.
  void take_quad(const std::vector<Triangle>& own, Nodes nodes, bool same) {
    if (own.empty()) return;
    if (!same) std::ranges::reverse(nodes);
    FacePart part{"quad", std::move(nodes), {}};
    double taken = 0.0;
    for (const Triangle& vertices : own) {
      std::vector<ReferencePoint>& piece = part.pieces.emplace_back();
      for (const std::int32_t vertex : vertices) piece.push_back(place_in(part.nodes, vertex));
      taken += reference_measure(piece);
    }
    if (taken > (1.0 - kRoundOff) * kReferenceArea) {
      quads_.insert(quads_.end(), part.nodes.begin(), part.nodes.end());
    } else {
      parts_.push_back(std::move(part));
    }
  }

  /// Where a vertex that lies in a quad is in its reference cell.
  [[nodiscard]] ReferencePoint place_in(const Nodes& quad, std::int32_t vertex) const {
    const Rider rider = rider_of(vertex);
    ReferencePoint place{};
    for (std::size_t k = 0; k < at(rider.count); ++k) {
      if (rider.weight[k] == 0.0) continue;
      const auto corner = std::ranges::find(quad, rider.node[k]) - quad.begin();
      for (std::size_t i = 0; i < place.size(); ++i)
        place[i] += rider.weight[k] * reference_quad_[static_cast<std::size_t>(corner)][i];
    }
    return place;
  }

  const CutState& cut_;
  std::vector<std::uint8_t> pressed_;  ///< whether a node of the first day has such a face
  std::set<Triangle> taken_;           ///< triangles that have the pressure, vertices ascending
  std::map<Nodes, Nodes> faces_;       ///< of the first day, by their nodes in ascending order
  std::map<std::int32_t, std::vector<Nodes>> faces_at_;  ///< the same, by each of their nodes
  Nodes triangles_;
  Nodes quads_;
  std::vector<CarriedFace> carried_;
  std::vector<FacePart> parts_;
  std::vector<ReferencePoint> reference_quad_ = reference_nodes("quad");
};

/// The faces whose cell is there, of a body that was never cut.
void keep_faces(const BodyDescription& body, PressureDescription& pressure) {
  const std::vector<FaceLeft> all = faces_left(*cut_state_now(body), pressure.first_day);
  pressure.faces.clear();
  auto one = all.begin();
  for (const FaceCells& some : pressure.first_day) {
    FaceCells left{some.element, {}, some.thickness};
    const auto count = at(find_element(some.element)->nodes);
    for (std::size_t i = 0; i + count <= some.nodes.size(); i += count) {
      const auto first = some.nodes.begin() + static_cast<std::ptrdiff_t>(i);
      if (!(one++)->parts.empty())
        left.nodes.insert(left.nodes.end(), first, first + static_cast<std::ptrdiff_t>(count));
    }
    if (!left.nodes.empty()) pressure.faces.push_back(std::move(left));
  }
}

}  // namespace

void part_pressures(std::vector<PressureDescription>& pressures, const BodyDescription& body) {
  for (PressureDescription& pressure : pressures) {
    if (pressure.body != body.name) continue;
    if (pressure.first_day.empty()) pressure.first_day = pressure.faces;
    if (body.cut != nullptr) {
      Pressed(*body.cut, pressure.first_day).find(pressure);
    } else {
      keep_faces(body, pressure);
    }
  }
}

void refuse_pressed(const WorldDescription& description, const BodyDescription& body) {
  for (const PressureDescription& pressure : description.pressures) {
    if (pressure.body != body.name) continue;
    for (const FaceCells& some : pressure.faces) {
      if (some.element == "triangle" || some.element == "quad") continue;
      const bool edge = find_element(some.element)->dimension == 1;
      throw ParameterError(
          "body \"" + body.name + "\" cannot be cut: the pressure \"" + pressure.name +
          (edge ? "\" acts on edges of a flat body, which a cut does not part yet; faces of a "
                  "volume or of a sheet are accepted, or leave the pressure out."
                : "\" acts on faces of type " + some.element +
                      ", which are curved and those of a cut are flat; cells of first order "
                      "are accepted, or leave the pressure out."));
    }
  }
}

}  // namespace tissu
