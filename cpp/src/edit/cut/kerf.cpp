#include "edit/cut/kerf.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "edit/cut/material_faces.h"
#include "edit/cut/patch.h"
#include "edit/cut/quad_halves.h"
#include "edit/cut/way_in.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

constexpr double kOfHeight =
    0.24;                       ///< of the least height of a tetrahedron: a depth at which it keeps its sense
constexpr double kFlat = 0.02;  ///< of the largest least height at a vertex: flatter ones do not count
constexpr double kSlant = 2.0;  ///< longest way over the depth
constexpr double kRoundOff = 1e-9;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// What is there of the surface around a vertex.
struct Around {
  std::vector<Vec3> walls;   ///< normals of opened faces, as long as twice their area
  std::vector<Vec3> others;  ///< of other faces, of length 1
  std::vector<MaterialTetra> tetrahedra;
  bool has_twin = false;  ///< another vertex stands in the same place
};

class Kerf {
 public:
  Kerf(const Hosts& hosts, const Material& material, const MaterialFaces& all)
      : hosts_(hosts), material_(material), all_(all) {
    for (const MaterialFace& face : all.faces) {
      if (face.across >= 0) continue;
      for (const std::int32_t v : face.vertices) around_[v];
    }
    find_twins();
    list_faces();
    std::erase_if(around_, [](const auto& one) { return one.second.walls.empty() && !one.second.has_twin; });
    list_tetrahedra();
  }

  [[nodiscard]] std::vector<std::pair<std::int32_t, Rider>> drawn_in(double depth) const {
    std::vector<std::pair<std::int32_t, Rider>> found;
    for (const auto& [vertex, around] : around_) {
      if (const auto rider = draw_in(vertex, around, depth); rider) found.emplace_back(vertex, *rider);
    }
    return found;
  }

 private:
  [[nodiscard]] Vec3 place(std::int32_t vertex) const { return material_.at(vertex, hosts_.rest()); }
  [[nodiscard]] Rider rider(std::int32_t vertex) const {
    if (vertex < 0) return material_.riders[at(-1 - vertex)];
    return {{vertex, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1};
  }

  /// Vertices that cuts parted have the same weights of copies of the same nodes.
  void find_twins() {
    using Key = std::vector<std::pair<std::int32_t, double>>;
    std::map<Key, std::vector<std::int32_t>> places;
    for (const auto& [vertex, around] : around_) {
      const Rider own = rider(vertex);
      Key key;
      for (std::size_t i = 0; i < at(own.count); ++i)
        key.emplace_back(hosts_.root(own.node[i]), own.weight[i]);
      std::ranges::sort(key);
      places[key].push_back(vertex);
    }
    for (const auto& [key, vertices] : places) {
      if (vertices.size() < 2) continue;
      for (const std::int32_t v : vertices) around_[v].has_twin = true;
    }
  }

  void list_faces() {
    for (const MaterialFace& face : all_.faces) {
      if (face.across >= 0) continue;
      const Vec3 a = place(face.vertices[0]);
      const Vec3 normal = (place(face.vertices[1]) - a).cross(place(face.vertices[2]) - a);
      if (!(normal.norm() > 0.0)) continue;
      for (const std::int32_t v : face.vertices) {
        if (face.cut) {
          around_[v].walls.push_back(normal);
        } else {
          around_[v].others.push_back(normal.normalized());
        }
      }
    }
  }

  void list_tetrahedra() {
    const auto add = [&](const MaterialTetra& tetra) {
      for (const std::int32_t v : tetra.vertices) {
        if (const auto found = around_.find(v); found != around_.end()) {
          found->second.tetrahedra.push_back(tetra);
        }
      }
    };
    for (const MaterialUnit& unit : all_.units) {
      if (unit.tetra >= 0) {
        add(material_.cells.at(unit.cell)[at(unit.tetra)]);
        continue;
      }
      const auto corners = hosts_.corners(unit.cell);
      if (std::ranges::none_of(corners, [&](std::int32_t node) { return around_.contains(node); })) continue;
      for (const MaterialTetra& tetra : whole_material(hosts_, unit.cell)) add(tetra);
    }
  }

  /// Where a vertex is met; nothing: where it is.
  [[nodiscard]] std::optional<Rider> draw_in(std::int32_t vertex, const Around& around, double depth) const {
    const double most = kOfHeight * thickness(around);
    if (!(most > 0.0)) return std::nullopt;
    if (const auto way = way_in(around.walls, around.others); way) {
      const Vec3 step = std::min(most, depth * std::min(way->slant, kSlant)) * way->along;
      if (const MaterialTetra* tetra = tetra_towards(vertex, around, step); tetra != nullptr) {
        return moved(*tetra, vertex, step);
      }
    }
    if (!around.has_twin) return std::nullopt;
    const MaterialTetra& largest = *std::ranges::max_element(
        around.tetrahedra, {}, [&](const MaterialTetra& tetra) { return volume(tetra); });
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : largest.vertices) middle += 0.25 * place(v);
    return moved(largest, vertex, std::min(most, depth) * (middle - place(vertex)).normalized());
  }

  /// The tetrahedron at the vertex into which a step leads; null: none.
  [[nodiscard]] const MaterialTetra* tetra_towards(std::int32_t vertex, const Around& around,
                                                   const Vec3& step) const {
    const MaterialTetra* best = nullptr;
    double inside = -kRoundOff;
    for (const MaterialTetra& tetra : around.tetrahedra) {
      const std::array<double, 4> weights = weights_of(tetra, vertex, step);
      double least = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (tetra.vertices[i] != vertex) least = std::min(least, weights[i]);
      }
      if (!(least >= inside) || (best != nullptr && least == inside)) continue;
      best = &tetra;
      inside = least;
    }
    return best;
  }

  /// The least height of the tetrahedra at a vertex, but for flat ones [m].
  [[nodiscard]] double thickness(const Around& around) const {
    double largest = 0.0;
    for (const MaterialTetra& tetra : around.tetrahedra) largest = std::max(largest, least_height(tetra));
    double least = largest;
    for (const MaterialTetra& tetra : around.tetrahedra) {
      if (const double height = least_height(tetra); height > kFlat * largest)
        least = std::min(least, height);
    }
    return least;
  }

  /// Of the vertices of a tetrahedron, whose sum with them is the vertex and the step.
  [[nodiscard]] std::array<double, 4> weights_of(const MaterialTetra& tetra, std::int32_t vertex,
                                                 const Vec3& step) const {
    const auto own =
        static_cast<std::size_t>(std::ranges::find(tetra.vertices, vertex) - tetra.vertices.begin());
    const Vec3 origin = place(vertex);
    Mat3 edges;
    Eigen::Index column = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != own) edges.col(column++) = place(tetra.vertices[i]) - origin;
    }
    const Vec3 shares = edges.partialPivLu().solve(step);
    std::array<double, 4> weights{};
    column = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != own) weights[i] = shares[column++];
    }
    weights[own] = 1.0 - shares.sum();
    return weights;
  }

  /// Nothing where more than four nodes would carry it.
  [[nodiscard]] std::optional<Rider> moved(const MaterialTetra& tetra, std::int32_t vertex,
                                           const Vec3& step) const {
    const std::array<double, 4> weights = weights_of(tetra, vertex, step);
    std::map<std::int32_t, double> sums;
    for (std::size_t i = 0; i < 4; ++i) {
      const Rider own = rider(tetra.vertices[i]);
      for (std::size_t k = 0; k < at(own.count); ++k) sums[own.node[k]] += weights[i] * own.weight[k];
    }
    if (sums.size() > 4) return std::nullopt;
    Rider result;
    for (const auto& [node, weight] : sums) {
      if (!std::isfinite(weight)) return std::nullopt;
      result.node[at(result.count)] = node;
      result.weight[at(result.count++)] = weight;
    }
    return result;
  }

  [[nodiscard]] double volume(const MaterialTetra& tetra) const {
    const Vec3 a = place(tetra.vertices[0]);
    return (place(tetra.vertices[1]) - a)
               .cross(place(tetra.vertices[2]) - a)
               .dot(place(tetra.vertices[3]) - a) /
           6.0;
  }
  [[nodiscard]] double least_height(const MaterialTetra& tetra) const {
    double largest = 0.0;
    for (const auto& [i, j, k] : kOpposite) {
      const Vec3 a = place(tetra.vertices[i]);
      const Vec3 twice = (place(tetra.vertices[j]) - a).cross(place(tetra.vertices[k]) - a);
      largest = std::max(largest, 0.5 * twice.norm());
    }
    return largest > 0.0 ? 3.0 * volume(tetra) / largest : 0.0;
  }

  const Hosts& hosts_;
  const Material& material_;
  const MaterialFaces& all_;
  std::map<std::int32_t, Around> around_;
};

/// The outer faces of a cell that no blade met: its quads where both halves are outside.
void add_whole(const Hosts& hosts, std::int32_t cell, std::span<const MaterialFace> faces_of,
               std::vector<std::array<std::int32_t, 3>>& triangles) {
  const auto nodes = hosts.corners(cell);
  const auto root = [&](std::int32_t node) { return hosts.root(node); };
  std::size_t next = 0;
  for (const LocalFace& face : faces(hosts.type(cell))) {
    const MaterialFace& first = faces_of[next++];
    if (face.corners == 3) {
      if (first.across < 0) triangles.push_back(first.vertices);
      continue;
    }
    const MaterialFace& second = faces_of[next++];
    if (first.across < 0 && second.across < 0) {
      add_halves(hosts.rest(),
                 {nodes[face.node[0]], nodes[face.node[1]], nodes[face.node[2]], nodes[face.node[3]]}, root,
                 triangles);
    } else if (first.across < 0) {
      triangles.push_back(first.vertices);
    } else if (second.across < 0) {
      triangles.push_back(second.vertices);
    }
  }
}

std::vector<std::array<std::int32_t, 3>> outer_triangles(const Hosts& hosts, const MaterialFaces& all) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::size_t f = 0; f < all.faces.size();) {
    const std::int32_t unit = all.faces[f].unit;
    std::size_t end = f;
    while (end < all.faces.size() && all.faces[end].unit == unit) ++end;
    const auto own = std::span(all.faces).subspan(f, end - f);
    if (all.units[at(unit)].tetra < 0) {
      add_whole(hosts, all.units[at(unit)].cell, own, triangles);
    } else {
      for (const MaterialFace& face : own) {
        if (face.across < 0) triangles.push_back(face.vertices);
      }
    }
    f = end;
  }
  return triangles;
}

}  // namespace

KerfSurface kerf_surface(const Hosts& hosts, const Material& material, double depth) {
  const MaterialFaces all = material_faces(hosts, material, 3);
  KerfSurface surface;
  surface.triangles = outer_triangles(hosts, all);
  std::set<std::int32_t> riding;
  for (const auto& triangle : surface.triangles) {
    for (const std::int32_t v : triangle) {
      if (v < 0) riding.insert(v);
    }
  }
  std::map<std::int32_t, Rider> carried;
  for (const std::int32_t v : riding) carried[v] = material.riders[at(-1 - v)];
  if (depth > 0.0) {
    for (const auto& [vertex, rider] : Kerf(hosts, material, all).drawn_in(depth)) carried[vertex] = rider;
  }
  surface.carried.assign(carried.begin(), carried.end());
  return surface;
}

}  // namespace tissu
