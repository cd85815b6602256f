#include "edit/cut/drawn_in.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "edit/cut/patch.h"
#include "edit/cut/riders.h"
#include "edit/cut/way_in.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kOfHeight =
    0.24;                       ///< of the least height of a tetrahedron: a depth at which it keeps its sense
constexpr double kFlat = 0.02;  ///< of the largest least height at a vertex: flatter ones do not count
constexpr double kSlant = 2.0;  ///< longest way over the depth
constexpr double kRoundOff = 1e-9;

/// What is there of the surface around a vertex.
struct Around {
  std::vector<Vec3> walls;   ///< normals of opened faces, as long as twice their area
  std::vector<Vec3> others;  ///< of other faces, of length 1
  std::vector<MaterialTetra> tetrahedra;
  bool has_twin = false;  ///< another vertex stands in the same place
};

class Kerf {
 public:
  Kerf(const Hosts& hosts, const Material& material, const MaterialFaces& all, const TwinFlags& vertices)
      : hosts_(hosts), material_(material), all_(all) {
    around_.reserve(vertices.size());
    for (const auto& [vertex, has_twin] : vertices) around_[vertex].has_twin = has_twin;
    list_faces();
    std::erase_if(around_, [](const auto& one) { return one.second.walls.empty() && !one.second.has_twin; });
    list_tetrahedra();
  }

  [[nodiscard]] std::vector<std::pair<std::int32_t, Rider>> drawn_in(double depth) const {
    std::vector<std::pair<std::int32_t, Rider>> found;
    for (const auto& [vertex, around] : around_) {
      if (const auto rider = draw_in(vertex, around, depth); rider) found.emplace_back(vertex, *rider);
    }
    std::ranges::sort(found, {}, [](const auto& one) { return one.first; });
    return found;
  }

 private:
  [[nodiscard]] Vec3 place(std::int32_t vertex) const { return material_.at(vertex, hosts_.rest()); }

  void list_faces() {
    for (const MaterialFace& face : all_.faces) {
      if (face.across >= 0) continue;
      std::array<Around*, 3> around{};
      std::ranges::transform(face.vertices, around.begin(), [&](std::int32_t v) { return around_at(v); });
      if (std::ranges::all_of(around, [](const Around* one) { return one == nullptr; })) continue;
      const Vec3 a = place(face.vertices[0]);
      const Vec3 normal = (place(face.vertices[1]) - a).cross(place(face.vertices[2]) - a);
      if (!(normal.norm() > 0.0)) continue;
      for (Around* one : around) {
        if (one == nullptr) continue;
        if (face.cut) {
          one->walls.push_back(normal);
        } else {
          one->others.push_back(normal.normalized());
        }
      }
    }
  }

  [[nodiscard]] Around* around_at(std::int32_t vertex) {
    const auto found = around_.find(vertex);
    return found == around_.end() ? nullptr : &found->second;
  }

  void list_tetrahedra() {
    const auto add = [&](const MaterialTetra& tetra) {
      for (const std::int32_t v : tetra.vertices) {
        if (Around* one = around_at(v); one != nullptr) one->tetrahedra.push_back(tetra);
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
        return moved(*tetra, vertex, kept_short(vertex, around, step));
      }
    }
    if (!around.has_twin) return std::nullopt;
    const MaterialTetra& largest = *std::ranges::max_element(
        around.tetrahedra, {}, [&](const MaterialTetra& tetra) { return volume(tetra); });
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : largest.vertices) middle += 0.25 * place(v);
    const Vec3 step = std::min(most, depth) * (middle - place(vertex)).normalized();
    return moved(largest, vertex, kept_short(vertex, around, step));
  }

  /// A step, shortened so that it takes no more than its share of the height of any tetrahedron at the
  /// vertex: a flat one that turned over would lay one wall through another.
  [[nodiscard]] Vec3 kept_short(std::int32_t vertex, const Around& around, const Vec3& step) const {
    double share = 1.0;
    for (const MaterialTetra& tetra : around.tetrahedra) {
      const double before = volume(tetra);
      const double lost = 1.0 - volume(tetra, vertex, step) / before;
      if (before > 0.0 && share * lost > kOfHeight) share = kOfHeight / lost;
    }
    return share * step;
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
    return between(material_, tetra.vertices, weights_of(tetra, vertex, step));
  }

  /// With a step of one of its vertices.
  [[nodiscard]] double volume(const MaterialTetra& tetra, std::int32_t moved = kNoVertex,
                              const Vec3& step = Vec3::Zero()) const {
    const auto corner = [&](std::size_t i) -> Vec3 {
      const std::int32_t v = tetra.vertices[i];
      return v == moved ? Vec3(place(v) + step) : place(v);
    };
    const Vec3 a = corner(0);
    return (corner(1) - a).cross(corner(2) - a).dot(corner(3) - a) / 6.0;
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
  std::unordered_map<std::int32_t, Around> around_;
};

}  // namespace

std::vector<std::pair<std::int32_t, Rider>> drawn_in(const Hosts& hosts, const Material& material,
                                                     const MaterialFaces& all, const TwinFlags& vertices,
                                                     double depth) {
  return Kerf(hosts, material, all, vertices).drawn_in(depth);
}

}  // namespace tissu
