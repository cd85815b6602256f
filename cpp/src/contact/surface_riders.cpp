/// Vertices that several rows carry, and what moves with which row.

#include <algorithm>
#include <limits>

#include "tissu/base/index.h"
#include "tissu/contact/surface_set.h"

namespace tissu {

Vec3 SurfaceSet::ride(const SurfaceRiders& riders, std::size_t number, std::int32_t first_row,
                      SurfaceVertex& vertex, ConstReals rest) {
  vertex.rider = static_cast<std::int32_t>(rider_begin_.size()) - 1;
  Vec3 place = Vec3::Zero();
  for (auto i = at(riders.begin[number]); i < at(riders.begin[number + 1]); ++i) {
    const std::int32_t row = first_row + riders.node[i];
    rider_part_.push_back({row, riders.weight[i], -1});
    place += riders.weight[i] * block(rest, row);
    if (riders.arm.empty()) continue;
    rider_turn_.resize(rider_part_.size());
    rider_turn_.back().arm = block(ConstReals(riders.arm), static_cast<std::int32_t>(i));
    place += riders.weight[i] * rider_turn_.back().arm;  // rotations are none at rest
  }
  rider_begin_.push_back(static_cast<std::int32_t>(rider_part_.size()));
  return place;
}

void SurfaceSet::list_movers(const ContactDescription& description,
                             std::span<const std::int32_t> first_node) {
  std::int32_t low = std::numeric_limits<std::int32_t>::max();
  std::int32_t high = -1;
  const auto extend = [&](std::int32_t row) {
    low = std::min(low, row);
    high = std::max(high, row);
  };
  for (const SurfaceVertex& vertex : vertices_) {
    if (vertex.row >= 0) extend(vertex.row);
  }
  for (const RiderPart& part : rider_part_) extend(part.row);
  std::vector<std::int32_t> movers(at(high - low) + 1, -1);  // by rows
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].row >= 0) movers[at(vertices_[v].row - low)] = static_cast<std::int32_t>(v);
  }
  for (const SurfaceVertex& vertex : vertices_) {
    if (vertex.rider < 0) continue;
    const auto first = at(rider_begin_[at(vertex.rider)]);
    for (auto i = first; i < at(rider_begin_[at(vertex.rider) + 1]); ++i) {
      RiderPart& part = rider_part_[i];
      std::int32_t& mover = movers[at(part.row - low)];
      if (mover < 0) {
        mover = static_cast<std::int32_t>(mover_count());
        inner_rows_.push_back({part.row, vertex.surface});
      }
      part.mover = mover;
      has_shared_rows_ = has_shared_rows_ || surface_of_mover(mover) != vertex.surface;
    }
  }
  list_carried();
  root_.assign(mover_count(), -1);
  for (std::int32_t row = low; row <= high; ++row) {
    const std::int32_t mover = movers[at(row - low)];
    if (mover < 0) continue;
    const std::int32_t surface = surface_of_mover(mover);
    const std::vector<std::int32_t>& roots = description.bodies[at(surface)].roots;
    const std::int32_t first = first_node[at(surface)];
    root_[at(mover)] = roots.empty() ? row : first + roots[at(row - first)];
  }
}

/// The vertices of each mover, ascending.
void SurfaceSet::list_carried() {
  carried_begin_.assign(mover_count() + 1, 0);
  for (const RiderPart& part : rider_part_) ++carried_begin_[at(part.mover) + 1];
  for (std::size_t m = 0; m < mover_count(); ++m) carried_begin_[m + 1] += carried_begin_[m];
  carried_.resize(rider_part_.size());
  std::vector<std::int32_t> next(carried_begin_.begin(), carried_begin_.end() - 1);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].rider < 0) continue;
    for (const RiderPart& part : parts(vertices_[v]))
      carried_[at(next[at(part.mover)]++)] = {static_cast<std::int32_t>(v), part.weight};
  }
}

std::int32_t SurfaceSet::surface_of_mover(std::int32_t mover) const {
  const std::size_t count = vertices_.size();
  return at(mover) < count ? vertices_[at(mover)].surface : inner_rows_[at(mover) - count].surface;
}

std::span<const SurfaceSet::Carried> SurfaceSet::carried_by(std::int32_t mover) const {
  const auto first = at(carried_begin_[at(mover)]);
  return std::span(carried_).subspan(first, at(carried_begin_[at(mover) + 1]) - first);
}

bool SurfaceSet::is_among(const std::vector<std::int32_t>& nodes, std::int32_t vertex) const {
  const SurfaceVertex& v = vertices_[at(vertex)];
  if (std::ranges::binary_search(nodes, v.node)) return true;
  if (v.rider < 0) return false;
  const std::int32_t first = surfaces_[at(v.surface)].first_row;
  return std::ranges::all_of(
      parts(v), [&](const RiderPart& part) { return std::ranges::binary_search(nodes, part.row - first); });
}

bool SurfaceSet::is_joined(std::span<const std::int32_t> first, std::span<const std::int32_t> second) const {
  const auto any_mover = [&](std::span<const std::int32_t> side, auto&& is_wanted) {
    return std::ranges::any_of(side, [&](std::int32_t v) {
      if (v < 0) return false;
      if (vertices_[at(v)].rider < 0) return is_wanted(v);
      return std::ranges::any_of(parts(vertices_[at(v)]),
                                 [&](const RiderPart& part) { return is_wanted(part.mover); });
    });
  };
  bool shared = false;
  const bool parted = any_mover(first, [&](std::int32_t m) {
    return any_mover(second, [&](std::int32_t n) {
      shared = shared || m == n;
      return m != n && root_[at(m)] == root_[at(n)];
    });
  });
  return shared && !parted;
}

void SurfaceSet::place_riders(Reals places, std::span<const Quaternion> rotations) const {
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].rider < 0) continue;
    Vec3 place = Vec3::Zero();
    for (const RiderPart& part : parts(vertices_[v])) place += part.weight * block(places, part.mover);
    if (has_turning_riders()) place += turned(vertices_[v], rotations);
    block(places, static_cast<std::int32_t>(v)) = place;
  }
}

}  // namespace tissu
