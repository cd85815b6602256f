/// Vertices that several rows carry, and what moves with which row.

#include <algorithm>
#include <map>

#include "tissu/contact/surface_set.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

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
  std::map<std::int32_t, std::int32_t> movers;  // by rows
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].row >= 0) movers[vertices_[v].row] = static_cast<std::int32_t>(v);
  }
  std::vector<std::vector<Carried>> carried(vertices_.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].rider < 0) continue;
    const auto first = at(rider_begin_[at(vertices_[v].rider)]);
    for (auto i = first; i < at(rider_begin_[at(vertices_[v].rider) + 1]); ++i) {
      RiderPart& part = rider_part_[i];
      const std::int32_t surface = vertices_[v].surface;
      const auto next = static_cast<std::int32_t>(mover_count());
      const auto [found, is_new] = movers.try_emplace(part.row, next);
      if (is_new) {
        inner_rows_.push_back({part.row, surface});
        carried.emplace_back();
      }
      part.mover = found->second;
      has_shared_rows_ = has_shared_rows_ || surface_of_mover(part.mover) != surface;
      carried[at(part.mover)].push_back({static_cast<std::int32_t>(v), part.weight});
    }
  }
  carried_begin_.assign(1, 0);
  for (const std::vector<Carried>& list : carried) {
    carried_.insert(carried_.end(), list.begin(), list.end());
    carried_begin_.push_back(static_cast<std::int32_t>(carried_.size()));
  }
  root_.assign(mover_count(), -1);
  for (const auto& [row, mover] : movers) {
    const std::int32_t surface = surface_of_mover(mover);
    const std::vector<std::int32_t>& roots = description.bodies[at(surface)].roots;
    const std::int32_t first = first_node[at(surface)];
    root_[at(mover)] = roots.empty() ? row : first + roots[at(row - first)];
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
