#include "edit/cut/movable.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "edit/cut/remedies.h"

namespace tissu {
namespace {

constexpr double kLeastQuality = 0.1;
constexpr double kOfBefore = 1.0 / 3.0;
constexpr double kLongestWay = 0.5;    ///< of an edge
constexpr double kOutOfPlane = 1e-12;  ///< of an edge: rounding of places
constexpr double kOutside = 1e-9;      ///< a weight of a corner so far below 0 is rounding

using Corners = std::array<Vec3, 4>;

Corners corners_of(std::span<const std::int32_t> nodes, ConstReals places) {
  Corners corner;
  for (std::size_t i = 0; i < 4; ++i) corner[i] = block(places, nodes[i]);
  return corner;
}

double six_volumes(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]); }

double quality(const Corners& c) { return tetra_quality(c[0], c[1], c[2], c[3]); }

/// The weights of four corners at a place, which sum to 1; nothing outside, and in a cell without a volume.
std::optional<std::array<double, 4>> weights_at(const Corners& c, const Vec3& place) {
  const double whole = six_volumes(c);
  if (!(whole > 0.0)) return std::nullopt;
  std::array<double, 4> weights{};
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    Corners part = c;
    part[i] = place;
    weights[i] = six_volumes(part) / whole;
    if (weights[i] < -kOutside) return std::nullopt;
    weights[i] = std::max(weights[i], 0.0);
    sum += weights[i];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

std::vector<Movable::Face> Movable::border(std::int32_t node) const {
  std::map<Face, int> counts;
  for (const std::int32_t cell : hosts_.cells_at(node)) {
    std::vector<std::int32_t> others;
    std::ranges::copy_if(hosts_.nodes(cell), std::back_inserter(others),
                         [node](std::int32_t other) { return other != node; });
    std::ranges::sort(others);
    for (std::size_t i = 0; i < 3; ++i) ++counts[{others[i == 0 ? 1U : 0U], others[i == 2 ? 1U : 2U]}];
  }
  std::vector<Face> faces;
  for (const auto& [face, count] : counts) {
    if (count == 1) faces.push_back(face);
  }
  return faces;
}

std::optional<Rider> Movable::locate(std::int32_t node, const Vec3& place) const {
  for (const std::int32_t cell : hosts_.cells_at(node)) {
    const auto nodes = hosts_.nodes(cell);
    const auto weights = weights_at(corners_of(nodes, x()), place);
    if (!weights) continue;
    Rider rider;
    for (std::size_t i = 0; i < 4; ++i) {
      rider.node[i] = nodes[i];
      rider.weight[i] = (*weights)[i];
    }
    rider.count = 4;
    return rider;
  }
  return std::nullopt;
}

double Movable::first_quality(std::int32_t cell) {
  const auto [known, is_new] = qualities_.try_emplace(cell, 0.0);
  if (is_new) known->second = quality(corners_of(before_->nodes(cell), before_->rest()));
  return known->second;
}

std::optional<double> Movable::quality_after(const NodeMove& move, double length) {
  const Vec3 rest = move.to.at(hosts_.rest());
  const Vec3 now = move.to.at(x());
  const Vec3 way = rest - block(hosts_.rest(), move.node);
  if (!(way.norm() <= kLongestWay * length)) return std::nullopt;
  for (const auto& [a, b] : border(move.node)) {
    const Vec3 p = block(hosts_.rest(), move.node);
    const Vec3 normal = (block(hosts_.rest(), a) - p).cross(block(hosts_.rest(), b) - p).normalized();
    if (std::abs(normal.dot(way)) > kOutOfPlane * length) return std::nullopt;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t cell : hosts_.cells_at(move.node)) {
    const auto nodes = hosts_.nodes(cell);
    const auto place = static_cast<std::size_t>(std::ranges::find(nodes, move.node) - nodes.begin());
    Corners at_rest = corners_of(nodes, hosts_.rest());
    Corners present = corners_of(nodes, x());
    const bool sound = six_volumes(present) > 0.0;
    at_rest[place] = rest;
    present[place] = now;
    const double found = quality(at_rest);
    if (!(found >= std::max(kLeastQuality, kOfBefore * first_quality(cell)))) return std::nullopt;
    if (sound && !(six_volumes(present) > 0.0)) return std::nullopt;
    least = std::min(least, found);
  }
  return least;
}

void Movable::move(const NodeMove& move) {
  const Vec3 now = move.to.at(x());
  hosts_.move(move);
  block(Reals(x_), move.node) = now;
  moves_.push_back(move);
}

}  // namespace tissu
