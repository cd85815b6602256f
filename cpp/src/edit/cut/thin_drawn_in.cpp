#include "edit/cut/thin_drawn_in.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "edit/cut/riders.h"
#include "edit/cut/way_in.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kOfHeight = 0.24;  ///< of the least height: a depth at which a triangle keeps its sense
constexpr double kFlat = 0.02;  ///< of the largest least height at a vertex: flatter triangles do not count
constexpr double kSense = 0.1;  ///< of its area: what every triangle keeps, flat or not
constexpr double kSlant = 2.0;  ///< longest way over the depth
constexpr double kRoundOff = 1e-9;

using Side = std::pair<std::int32_t, std::int32_t>;
using Corners = std::array<std::int32_t, 3>;

/// What is there of sheets and lines around a vertex.
struct Around {
  std::vector<Vec3> walls;   ///< normals of opened edges in their triangle, as long as the edge
  std::vector<Vec3> others;  ///< of other edges of the rim, of length 1
  std::vector<Corners> triangles;
  std::vector<std::int32_t> other_ends;  ///< of the lines at the vertex
  bool is_cut = false;                   ///< a blade opened an edge or an end there
  bool has_twin = false;                 ///< another vertex stands in the same place
};

/// Where a vertex of a sheet goes: a way along one of its triangles.
struct Drawn {
  Corners triangle;
  Vec3 way;
};

class ThinKerf {
 public:
  ThinKerf(const Hosts& hosts, const Material& material, const ThinMaterial& thin)
      : hosts_(hosts), material_(material), triangles_(thin.triangles) {
    add_triangles(thin.triangles);
    add_lines(thin.lines);
    find_twins(thin.still);
    for (const std::int32_t v : thin.still) around_.erase(v);
  }

  [[nodiscard]] std::vector<std::pair<std::int32_t, Rider>> drawn_in(
      const std::function<double(std::int32_t)>& depth) const {
    std::map<std::int32_t, Rider> found;
    std::map<std::int32_t, Drawn> in_sheets;
    for (const auto& [vertex, around] : around_) {
      if (!around.is_cut && !around.has_twin) continue;
      if (around.triangles.empty()) {
        if (const auto rider = along_line(vertex, around, depth(vertex)); rider) found[vertex] = *rider;
      } else if (const auto drawn = into_sheet(vertex, around, depth(vertex)); drawn) {
        in_sheets[vertex] = *drawn;
      }
    }
    keep_senses(in_sheets);
    for (const auto& [vertex, drawn] : in_sheets) {
      if (const auto rider = rider_after(vertex, drawn); rider) found[vertex] = *rider;
    }
    return {found.begin(), found.end()};
  }

 private:
  [[nodiscard]] Vec3 place(std::int32_t vertex) const { return material_.at(vertex, hosts_.rest()); }

  void add_triangles(const std::vector<MaterialTetra>& triangles) {
    std::map<Side, int> uses;
    const auto for_sides = [&](const MaterialTetra& t, auto&& f) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t a = t.vertices[(i + 1) % 3];
        const std::int32_t b = t.vertices[(i + 2) % 3];
        f(a, b, t.vertices[i], (t.cut >> i & 1U) != 0);
      }
    };
    for (const MaterialTetra& t : triangles) {
      for_sides(t, [&](std::int32_t a, std::int32_t b, std::int32_t, bool) { ++uses[std::minmax(a, b)]; });
    }
    for (const MaterialTetra& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        around_[t.vertices[i]].triangles.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
      }
      for_sides(t, [&](std::int32_t a, std::int32_t b, std::int32_t across, bool cut) {
        if (!cut && uses.at(std::minmax(a, b)) > 1) return;
        add_side(a, b, across, cut);
      });
    }
  }

  /// An edge of the rim, opposite to a vertex of its triangle.
  void add_side(std::int32_t a, std::int32_t b, std::int32_t across, bool cut) {
    const Vec3 from = place(a);
    const Vec3 along = place(b) - from;
    const double length = along.norm();
    const Vec3 into = place(across) - from;
    const Vec3 outward = along * (along.dot(into) / (length * length)) - into;
    if (!(length > 0.0) || !(outward.norm() > 0.0)) return;
    for (const std::int32_t v : {a, b}) {
      Around& around = around_[v];
      around.is_cut = around.is_cut || cut;
      if (cut) {
        around.walls.emplace_back(length * outward.normalized());
      } else {
        around.others.emplace_back(outward.normalized());
      }
    }
  }

  void add_lines(const std::vector<MaterialTetra>& lines) {
    for (const MaterialTetra& piece : lines) {
      for (std::size_t i = 0; i < 2; ++i) {
        Around& around = around_[piece.vertices[i]];
        around.other_ends.push_back(piece.vertices[1 - i]);
        around.is_cut = around.is_cut || (piece.cut >> (1 - i) & 1U) != 0;
      }
    }
  }

  /// Where a vertex stands: the first-day nodes that carry it, with its weights; alike at copies.
  void find_twins(const std::set<std::int32_t>& still) {
    using Place = std::array<std::pair<std::int32_t, double>, 4>;
    std::map<Place, std::vector<std::int32_t>> here;
    const auto add = [&](std::int32_t v) {
      const Rider own = rider_of(material_, v);
      Place place;
      place.fill({-1, 0.0});
      for (std::size_t i = 0; i < at(own.count); ++i) place[i] = {hosts_.root(own.node[i]), own.weight[i]};
      std::sort(place.begin(), place.begin() + own.count);
      here[place].push_back(v);
    };
    for (const auto& [vertex, around] : around_) add(vertex);
    for (const std::int32_t v : still) {
      if (!around_.contains(v)) add(v);
    }
    for (const auto& [place, vertices] : here) {
      for (const std::int32_t v : vertices) {
        if (const auto found = around_.find(v); found != around_.end()) {
          found->second.has_twin = vertices.size() > 1;
        }
      }
    }
  }

  /// Where an end of a line is met; nothing: where it is.
  [[nodiscard]] std::optional<Rider> along_line(std::int32_t vertex, const Around& around,
                                                double depth) const {
    if (around.other_ends.size() > 1 && !around.has_twin) return std::nullopt;
    const auto length = [&](std::int32_t end) { return (place(end) - place(vertex)).norm(); };
    const std::int32_t end = *std::ranges::max_element(around.other_ends, {}, length);
    if (!(length(end) > 0.0)) return std::nullopt;
    const double share = std::min(kOfHeight, depth / length(end));
    return between(material_, std::array{vertex, end}, std::array{1.0 - share, share});
  }

  /// Where a vertex of a sheet is met; nothing: where it is.
  [[nodiscard]] std::optional<Drawn> into_sheet(std::int32_t vertex, const Around& around,
                                                double depth) const {
    const double most = kOfHeight * thickness(around);
    if (!(most > 0.0)) return std::nullopt;
    if (const auto way = way_in(around.walls, around.others); way) {
      const Vec3 step = std::min(most, depth * std::min(way->slant, kSlant)) * way->along;
      if (const auto drawn = towards(vertex, around, step); drawn) return drawn;
    }
    if (!around.has_twin) return std::nullopt;
    const Corners& largest = *std::ranges::max_element(
        around.triangles, {}, [&](const Corners& triangle) { return twice_area(triangle); });
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : largest) middle += place(v) / 3.0;
    return along(largest, vertex, std::min(most, depth) * (middle - place(vertex)).normalized());
  }

  /// A step in the triangle at the vertex into which it leads; nothing: it leads into none.
  [[nodiscard]] std::optional<Drawn> towards(std::int32_t vertex, const Around& around,
                                             const Vec3& step) const {
    const Corners* best = nullptr;
    double inside = -kRoundOff;
    for (const Corners& triangle : around.triangles) {
      const std::array<double, 3> weights = weights_of(triangle, vertex, step);
      double least = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        if (triangle[i] != vertex) least = std::min(least, weights[i]);
      }
      if (!(least >= inside) || (best != nullptr && least == inside)) continue;
      best = &triangle;
      inside = least;
    }
    if (best == nullptr) return std::nullopt;
    return along(*best, vertex, step);
  }

  /// In a sheet that is bent the step is that along the triangle. Nothing where nothing carries its end.
  [[nodiscard]] std::optional<Drawn> along(const Corners& triangle, std::int32_t vertex,
                                           const Vec3& step) const {
    const std::array<double, 3> weights = weights_of(triangle, vertex, step);
    if (!between(material_, triangle, weights)) return std::nullopt;
    Vec3 way = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) way += weights[i] * (place(triangle[i]) - place(vertex));
    return Drawn{triangle, way};
  }

  [[nodiscard]] std::optional<Rider> rider_after(std::int32_t vertex, const Drawn& drawn) const {
    return between(material_, drawn.triangle, weights_of(drawn.triangle, vertex, drawn.way));
  }

  /// Shortens ways until no triangle turns over: two edges of one material would cross in its plane. A flat
  /// triangle bounds the ways of its vertices only where it would do so. The longest of a triangle's ways is
  /// halved, until all are short beside its height.
  void keep_senses(std::map<std::int32_t, Drawn>& drawn) const {
    const auto way = [&](std::int32_t vertex) -> Vec3 {
      const auto found = drawn.find(vertex);
      return found == drawn.end() ? Vec3(Vec3::Zero()) : found->second.way;
    };
    std::set<std::int32_t> halved;
    do {
      halved.clear();
      for (const MaterialTetra& t : triangles_) {
        const std::array<std::int32_t, 3> corners = {t.vertices[0], t.vertices[1], t.vertices[2]};
        const auto length = [&](std::int32_t vertex) { return way(vertex).norm(); };
        const std::int32_t longest = *std::ranges::max_element(corners, {}, length);
        if (!(length(longest) > 0.0)) continue;
        const auto normal = [&](auto&& at) -> Vec3 {
          return (at(corners[1]) - at(corners[0])).cross(at(corners[2]) - at(corners[0]));
        };
        const Vec3 before = normal([&](std::int32_t v) { return place(v); });
        const Vec3 after = normal([&](std::int32_t v) -> Vec3 { return place(v) + way(v); });
        if (!(after.dot(before) < kSense * before.squaredNorm())) continue;
        halved.insert(longest);
      }
      for (const std::int32_t vertex : halved) drawn.at(vertex).way *= 0.5;
    } while (!halved.empty());
  }

  /// The least height of the triangles at a vertex, but for flat ones [m].
  [[nodiscard]] double thickness(const Around& around) const {
    double largest = 0.0;
    for (const Corners& triangle : around.triangles) largest = std::max(largest, least_height(triangle));
    double least = largest;
    for (const Corners& triangle : around.triangles) {
      if (const double height = least_height(triangle); height > kFlat * largest)
        least = std::min(least, height);
    }
    return least;
  }

  /// Of the vertices of a triangle, whose sum with them is the vertex and the step along the triangle.
  [[nodiscard]] std::array<double, 3> weights_of(const Corners& triangle, std::int32_t vertex,
                                                 const Vec3& step) const {
    const auto own = static_cast<std::size_t>(std::ranges::find(triangle, vertex) - triangle.begin());
    const std::size_t one = (own + 1) % 3;
    const std::size_t other = (own + 2) % 3;
    Eigen::Matrix<double, 3, 2> edges;
    edges.col(0) = place(triangle[one]) - place(vertex);
    edges.col(1) = place(triangle[other]) - place(vertex);
    const Eigen::Vector2d shares = (edges.transpose() * edges).inverse() * (edges.transpose() * step);
    std::array<double, 3> weights{};
    weights[own] = 1.0 - shares.sum();
    weights[one] = shares[0];
    weights[other] = shares[1];
    return weights;
  }

  [[nodiscard]] double twice_area(const Corners& triangle) const {
    const Vec3 a = place(triangle[0]);
    return (place(triangle[1]) - a).cross(place(triangle[2]) - a).norm();
  }
  [[nodiscard]] double least_height(const Corners& triangle) const {
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, (place(triangle[(i + 1) % 3]) - place(triangle[i])).norm());
    }
    return longest > 0.0 ? twice_area(triangle) / longest : 0.0;
  }

  const Hosts& hosts_;
  const Material& material_;
  const std::vector<MaterialTetra>& triangles_;
  std::map<std::int32_t, Around> around_;
};

}  // namespace

std::vector<std::pair<std::int32_t, Rider>> drawn_in(const Hosts& hosts, const Material& material,
                                                     const ThinMaterial& thin,
                                                     const std::function<double(std::int32_t)>& depth) {
  return ThinKerf(hosts, material, thin).drawn_in(depth);
}

}  // namespace tissu
