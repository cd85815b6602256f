#include "tissu/edit/cut/anchors.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace tissu {
namespace {

using Box = Eigen::AlignedBox3d;

/// A point this share of a tetrahedron's height outside of it is in it, for round-off.
constexpr double kSlack = 1e-9;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Box box_of(std::span<const std::int32_t> nodes, ConstReals x) {
  Box box;
  for (const std::int32_t node : nodes) box.extend(Vec3(block(x, node)));
  const double margin = kSlack * box.sizes().norm();
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

/// Weights of the vertices of a tetrahedron of the material as weights of nodes.
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
  for (std::size_t i = 0; i < 4; ++i) {
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
      const Box around = box_of(cluster.corners, x_);
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

  void look_in(std::int32_t cell, const std::vector<std::int32_t>& within) {
    const Box box = box_of(hosts_.corners(cell), x_);
    if (std::ranges::none_of(within, [&](std::int32_t i) { return box.contains(point(i)); })) return;
    const auto stored = material_.cells.find(cell);
    if (stored != material_.cells.end()) {
      for (const MaterialTetra& tetra : stored->second) look_in(cell, tetra, within);
    } else {
      for (const MaterialTetra& tetra : whole_material(hosts_, cell)) look_in(cell, tetra, within);
    }
  }

  void look_in(std::int32_t cell, const MaterialTetra& tetra, const std::vector<std::int32_t>& within) {
    std::array<Vec3, 4> corner;
    for (std::size_t i = 0; i < 4; ++i) corner[i] = material_.at(tetra.vertices[i], x_);
    std::array<double, 4> weights{};
    for (const std::int32_t i : within) {
      if (!weights_in(corner, point(i), weights)) return;
      const double depth = *std::ranges::min_element(weights);
      Best& best = best_[at(i)];
      if (depth < best.depth || (depth == best.depth && cell >= best.cell)) continue;
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
