#include "tissu/edit/cut/anchors.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "tissu/base/index.h"
#include "tissu/mesh/triangle_tree.h"

namespace tissu {
namespace {

using Box = Eigen::AlignedBox3d;

/// A point this share of a tetrahedron's height outside of it is in it, for round-off.
constexpr double kSlack = 1e-9;
/// Of a triangle's longest edge, or a line's length: so near a sheet or line a point goes with it.
constexpr double kNearSheet = 0.5;

Box box_of(std::span<const std::int32_t> nodes, ConstReals x, double grown) {
  Box box;
  for (const std::int32_t node : nodes) box.extend(Vec3(block(x, node)));
  const double margin = grown * box.sizes().norm();
  return {(box.min().array() - margin).matrix(), (box.max().array() + margin).matrix()};
}

/// The four weights of p in a tetrahedron; false where it is flat.
bool weights_in(const std::array<Vec3, 4>& corner, const Vec3& p, std::array<double, 4>& weights) {
  Mat3 sides;
  for (std::size_t i = 0; i < 3; ++i) sides.col(static_cast<Eigen::Index>(i)) = corner[i + 1] - corner[0];
  const double volume = sides.determinant();
  if (volume == 0.0) return false;
  const Vec3 inner = sides.inverse() * (p - corner[0]);
  if (!inner.allFinite()) return false;
  weights = {1.0 - inner.sum(), inner[0], inner[1], inner[2]};
  return true;
}

/// The three weights of a point in the plane of a triangle; false where it has no area.
bool weights_on(const std::array<Vec3, 4>& corner, const Vec3& p, std::array<double, 4>& weights) {
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double square = normal.squaredNorm();
  if (!(square > 0.0)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& a = corner[(i + 1) % 3];
    weights[i] = (corner[(i + 2) % 3] - a).cross(p - a).dot(normal) / square;
  }
  weights[3] = 0.0;
  return true;
}

/// The two weights of the nearest point of a piece of a line; false where it has no length.
bool weights_along(const Vec3& a, const Vec3& b, const Vec3& p, std::array<double, 4>& weights) {
  const double square = (b - a).squaredNorm();
  if (!(square > 0.0)) return false;
  const double t = std::clamp((p - a).dot(b - a) / square, 0.0, 1.0);
  weights = {1.0 - t, t, 0.0, 0.0};
  return true;
}

/// Weights of the vertices of a part of the material as weights of nodes.
Rider combined(const Material& material, const MaterialTetra& tetra, const std::array<double, 4>& weights) {
  Rider sum;
  const auto add = [&](std::int32_t node, double weight) {
    const auto end = sum.node.begin() + sum.count;
    const auto place = static_cast<std::size_t>(std::find(sum.node.begin(), end, node) - sum.node.begin());
    if (place >= sum.node.size()) return;  // material lies between four corners of its host
    if (place == at(sum.count)) {
      sum.node[place] = node;
      ++sum.count;
    }
    sum.weight[place] += weight;
  };
  for (std::size_t i = 0; i < tetra.corners(); ++i) {
    const std::int32_t vertex = tetra.vertices[i];
    if (vertex >= 0) {
      add(vertex, weights[i]);
      continue;
    }
    const Rider& rider = material.riders[at(-1 - vertex)];
    for (std::size_t k = 0; k < at(rider.count); ++k) add(rider.node[k], weights[i] * rider.weight[k]);
  }
  return sum;
}

class Search {
 public:
  Search(const Hosts& hosts, const Material& material, ConstReals x, ConstReals points)
      : hosts_(hosts), material_(material), x_(x), points_(points), best_(points.size() / 3) {}

  std::vector<Anchor> find() {
    std::vector<std::int32_t> within;
    for (const Hosts::Cluster& cluster : hosts_.clusters()) {
      const bool thin = std::ranges::any_of(cluster.cells, [&](std::int32_t cell) { return is_thin(cell); });
      const Box around = box_of(cluster.corners, x_, thin ? kNearSheet : kSlack);
      within.clear();
      for (std::size_t i = 0; i < best_.size(); ++i) {
        if (around.contains(point(static_cast<std::int32_t>(i))))
          within.push_back(static_cast<std::int32_t>(i));
      }
      if (within.empty()) continue;
      for (const std::int32_t cell : cluster.cells) look_in(cell, within);
    }
    std::vector<Anchor> found;
    found.reserve(best_.size());
    for (std::size_t i = 0; i < best_.size(); ++i) {
      found.push_back(best_[i].anchor.inside ? best_[i].anchor : beside(static_cast<std::int32_t>(i)));
    }
    return found;
  }

 private:
  struct Best {
    Anchor anchor;
    double depth = -kSlack;  ///< the least weight
    std::int32_t cell = std::numeric_limits<std::int32_t>::max();
  };
  [[nodiscard]] Vec3 point(std::int32_t i) const { return block(points_, i); }
  [[nodiscard]] bool is_thin(std::int32_t cell) const { return info(hosts_.type(cell)).dimension < 3; }

  void look_in(std::int32_t cell, const std::vector<std::int32_t>& within) {
    const Box box = box_of(hosts_.corners(cell), x_, is_thin(cell) ? kNearSheet : kSlack);
    if (std::ranges::none_of(within, [&](std::int32_t i) { return box.contains(point(i)); })) return;
    if (is_thin(cell) && hosts_.lies_in_volume(cell))
      return;  // a point goes with the volume, or passes it by
    for (const MaterialTetra& tetra : material_of(hosts_, material_, cell)) {
      if (tetra.corners() == 4) {
        look_in(cell, tetra, within);
      } else if (tetra.corners() == 3) {
        look_beside(cell, tetra, within);
      } else {
        look_along(cell, tetra, within);
      }
    }
  }

  /// A point near a sheet keeps its offset from the nearest point of it.
  void look_beside(std::int32_t cell, const MaterialTetra& triangle,
                   const std::vector<std::int32_t>& within) {
    std::array<Vec3, 4> corner;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = material_.at(triangle.vertices[i], x_);
    std::array<double, 9> numbers{};
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      std::copy_n(corner[i].data(), 3, &numbers[3 * i]);
      longest = std::max(longest, (corner[(i + 1) % 3] - corner[i]).norm());
    }
    std::array<double, 4> weights{};
    for (const std::int32_t i : within) {
      const Vec3 nearest = closest_on_triangle(point(i), numbers.data());
      const double away = (point(i) - nearest).norm();
      if (away > kNearSheet * longest || !is_nearest(i, away, cell)) continue;
      if (weights_on(corner, nearest, weights))
        go_with(i, away, cell, combined(material_, triangle, weights));
    }
  }

  /// The same of a line.
  void look_along(std::int32_t cell, const MaterialTetra& piece, const std::vector<std::int32_t>& within) {
    const Vec3 a = material_.at(piece.vertices[0], x_);
    const Vec3 b = material_.at(piece.vertices[1], x_);
    const auto ends = hosts_.corners(cell);
    const double length = (Vec3(block(x_, ends[0])) - Vec3(block(x_, ends[1]))).norm();
    std::array<double, 4> weights{};
    for (const std::int32_t i : within) {
      if (!weights_along(a, b, point(i), weights)) return;
      const double away = (point(i) - (weights[0] * a + weights[1] * b)).norm();
      if (away > kNearSheet * length || !is_nearest(i, away, cell)) continue;
      go_with(i, away, cell, combined(material_, piece, weights));
    }
  }

  [[nodiscard]] bool is_nearest(std::int32_t i, double away, std::int32_t cell) const {
    const Best& best = best_[at(i)];
    return !best.anchor.inside || -away > best.depth || (-away == best.depth && cell < best.cell);
  }

  void go_with(std::int32_t i, double away, std::int32_t cell, const Rider& rider) {
    best_[at(i)] = {{rider, point(i) - rider.at(x_), true}, -away, cell};
  }

  void look_in(std::int32_t cell, const MaterialTetra& tetra, const std::vector<std::int32_t>& within) {
    std::array<Vec3, 4> corner;
    for (std::size_t i = 0; i < 4; ++i) corner[i] = material_.at(tetra.vertices[i], x_);
    std::array<double, 4> weights{};
    for (const std::int32_t i : within) {
      if (!weights_in(corner, point(i), weights)) return;
      const double depth = *std::ranges::min_element(weights);
      Best& best = best_[at(i)];
      if (depth < -kSlack || depth < best.depth || (depth == best.depth && cell >= best.cell)) continue;
      best = {{combined(material_, tetra, weights), Vec3::Zero(), true}, depth, cell};
    }
  }

  [[nodiscard]] Anchor beside(std::int32_t i) const {
    std::int32_t nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t node = 0; node < hosts_.node_count(); ++node) {
      if (hosts_.cells_at(node).empty()) continue;
      const double square = (Vec3(block(x_, node)) - point(i)).squaredNorm();
      if (square < least) {
        least = square;
        nearest = node;
      }
    }
    if (nearest < 0) return {{}, point(i), false};
    return {{{nearest, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1}, point(i) - Vec3(block(x_, nearest)), false};
  }

  const Hosts& hosts_;
  const Material& material_;
  ConstReals x_;
  ConstReals points_;
  std::vector<Best> best_;
};

}  // namespace

std::vector<Anchor> anchors(const Hosts& hosts, const Material& material, ConstReals x, ConstReals points) {
  return Search(hosts, material, x, points).find();
}

}  // namespace tissu
