#include "edit/cut/near.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tissu {
namespace {

using Box = Eigen::AlignedBox3d;

/// A triangle's box, and its plane n . x = offset.
struct Plate {
  Box box;
  Vec3 normal;
  double offset;
};

/// Boxes grow by round-off's share of their place and size.
constexpr double kMargin = 1e-12;

Box grown(const Box& box) {
  const double size = kMargin * (box.min().cwiseAbs().maxCoeff() + box.max().cwiseAbs().maxCoeff());
  return {(box.min().array() - size).matrix(), (box.max().array() + size).matrix()};
}

Plate plate(const std::array<Vec3, 3>& triangle) {
  Box box;
  for (const Vec3& p : triangle) box.extend(p);
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  return {grown(box), normal, normal.dot(triangle[0])};
}

bool meet(const Box& box, const Plate& plate) {
  if (!box.intersects(plate.box)) return false;
  const double reach = 0.5 * box.sizes().dot(plate.normal.cwiseAbs());
  const double slack =
      kMargin * (std::abs(plate.offset) + box.max().cwiseAbs().maxCoeff() + box.min().cwiseAbs().maxCoeff());
  return std::abs(plate.normal.dot(box.center()) - plate.offset) <= reach + slack;
}

Box box_of(std::span<const std::int32_t> nodes, ConstReals x) {
  Box box;
  for (const std::int32_t node : nodes) box.extend(block(x, node));
  return grown(box);
}

/// The box of how far nodes are from where they are at rest.
Box shifts(ConstReals rest, ConstReals x) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double shift = x[i + k] - rest[i + k];
      const auto axis = static_cast<Eigen::Index>(k);
      low[axis] = std::min(low[axis], shift);
      high[axis] = std::max(high[axis], shift);
    }
  }
  return {low, high};
}

/// A box that holds what lay in one at rest, wherever it has gone.
Box shifted(const Box& rest, const Box& shift) {
  const auto size = [](const Box& box) {
    return box.min().cwiseAbs().maxCoeff() + box.max().cwiseAbs().maxCoeff();
  };
  const double margin = 4.0 * kMargin * (size(rest) + size(shift));
  return {(rest.min() + shift.min()).array() - margin, (rest.max() + shift.max()).array() + margin};
}

}  // namespace

NearCells::NearCells(const Hosts& hosts, ConstReals x, const SweepPart& part) {
  std::vector<Plate> plates;
  Box whole;
  for (const auto& triangle : part.triangles) {
    plates.push_back(plate(triangle));
    whole.extend(plates.back().box);
  }
  using Entry = std::pair<std::int32_t, std::int32_t>;
  std::vector<Entry> found;  // cell, triangle
  std::vector<std::int32_t> hits;
  const Box shift = shifts(hosts.rest(), x);
  for (const Hosts::Cluster& cluster : hosts.clusters()) {
    if (cluster.rest.isEmpty() || !shifted(cluster.rest, shift).intersects(whole)) continue;
    const Box around = box_of(cluster.corners, x);
    if (!around.intersects(whole)) continue;
    hits.clear();
    for (std::size_t t = 0; t < plates.size(); ++t) {
      if (meet(around, plates[t])) hits.push_back(static_cast<std::int32_t>(t));
    }
    if (hits.empty()) continue;
    for (const std::int32_t cell : cluster.cells) {
      const Box box = box_of(hosts.corners(cell), x);
      if (!box.intersects(whole)) continue;
      for (const std::int32_t t : hits) {
        if (meet(box, plates[static_cast<std::size_t>(t)])) found.emplace_back(cell, t);
      }
    }
  }
  std::ranges::sort(found);
  for (const auto& [cell, triangle] : found) {
    if (cells_.empty() || cells_.back() != cell) {
      cells_.push_back(cell);
      first_.push_back(static_cast<std::int32_t>(triangles_.size()));
    }
    triangles_.push_back(triangle);
  }
  first_.push_back(static_cast<std::int32_t>(triangles_.size()));
}

std::span<const std::int32_t> NearCells::triangles(std::int32_t cell) const {
  const auto place = std::ranges::lower_bound(cells_, cell);
  if (place == cells_.end() || *place != cell) return {};
  const auto i = static_cast<std::size_t>(place - cells_.begin());
  return std::span(triangles_)
      .subspan(static_cast<std::size_t>(first_[i]), static_cast<std::size_t>(first_[i + 1] - first_[i]));
}

}  // namespace tissu
