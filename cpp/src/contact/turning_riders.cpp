/// Vertices that frames carry with their rotations: p = sum w (x + R arm). Nodes of lines that are frames,
/// about which the surface of the line turns.

#include <algorithm>
#include <unordered_map>

#include "tissu/base/index.h"
#include "tissu/contact/surface_set.h"

namespace tissu {

void SurfaceSet::find_frames(std::span<const Frame> frames) {
  rider_turn_.resize(rider_part_.size());  // of surfaces whose nodes have no rotation
  std::unordered_map<std::int32_t, std::int32_t> by_row;
  for (std::size_t k = 0; k < frames.size(); ++k) by_row[frames[k].block] = static_cast<std::int32_t>(k);
  for (std::size_t i = 0; i < rider_turn_.size(); ++i) {
    const auto found = by_row.find(rider_part_[i].row);
    if (found == by_row.end() || rider_turn_[i].arm.isZero(0.0)) continue;
    rider_turn_[i].frame = found->second;
    rider_turn_[i].row = frames[at(found->second)].rotation;
  }
}

/// Where lines rub: without friction a force leads through their middle.
void SurfaceSet::find_rollers(const ContactDescription& description, std::span<const Frame> frames) {
  if (frames.empty()) return;
  std::unordered_map<std::int32_t, std::size_t> by_row;
  for (std::size_t k = 0; k < frames.size(); ++k) by_row[frames[k].block] = k;
  for (SurfaceVertex& vertex : vertices_) {
    if (vertex.row < 0 || vertex.has_faces || vertex.radius == 0.0) continue;
    const auto found = by_row.find(vertex.row);
    const bool rubs = std::ranges::any_of(description.pairs, [&](const ContactPair& pair) {
      return pair.friction > 0.0 && (pair.a == vertex.surface || pair.b == vertex.surface);
    });
    if (found == by_row.end() || !rubs) continue;
    vertex.roller = static_cast<std::int32_t>(rollers_.size());
    rollers_.push_back({static_cast<std::int32_t>(found->second), frames[found->second].rotation});
  }
}

void SurfaceSet::list_rotations() {
  for (const SurfaceCarrier& carrier : carriers_) {
    rotations_.push_back({carrier.frame, carrier.rotation, -1});
  }
  const auto first = static_cast<std::ptrdiff_t>(rotations_.size());
  for (std::size_t i = 0; i < rider_turn_.size(); ++i) {
    const RiderTurn& turn = rider_turn_[i];
    if (turn.frame >= 0) rotations_.push_back({turn.frame, turn.row, rider_part_[i].mover});
  }
  std::ranges::sort(rotations_.begin() + first, rotations_.end(), {}, &SurfaceRotation::frame);
  const auto same =
      std::ranges::unique(rotations_.begin() + first, rotations_.end(), {}, &SurfaceRotation::frame);
  rotations_.erase(same.begin(), same.end());
  const auto is_listed = [&](std::int32_t frame) {
    return std::ranges::binary_search(rotations_.begin() + first, rotations_.end(), frame, {},
                                      &SurfaceRotation::frame);
  };
  std::vector<SurfaceRotation> others;
  for (const Roller& roller : rollers_) {
    if (!is_listed(roller.frame)) others.push_back({roller.frame, roller.rotation, -1});
  }
  rotations_.insert(rotations_.end(), others.begin(), others.end());
}

Vec3 SurfaceSet::turned(const SurfaceVertex& vertex, std::span<const Quaternion> rotations) const {
  Vec3 sum = Vec3::Zero();
  const std::span<const RiderPart> of = parts(vertex);
  const std::span<const RiderTurn> with = turns(vertex);
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (with[i].frame >= 0) sum += of[i].weight * (rotations[at(with[i].frame)] * with[i].arm);
  }
  return sum;
}

bool SurfaceSet::is_of_one_row(std::span<const std::int32_t> first,
                               std::span<const std::int32_t> second) const {
  if (!has_shared_rows_) return false;
  const auto any_row = [&](std::span<const std::int32_t> side, auto&& is_wanted) {
    return std::ranges::any_of(side, [&](std::int32_t v) {
      if (v < 0) return false;
      const SurfaceVertex& vertex = vertices_[at(v)];
      if (vertex.rider < 0) return vertex.row >= 0 && is_wanted(vertex.row);
      return std::ranges::any_of(parts(vertex), [&](const RiderPart& part) { return is_wanted(part.row); });
    });
  };
  return any_row(first, [&](std::int32_t row) {
    return any_row(second, [&](std::int32_t other) { return row == other; });
  });
}

}  // namespace tissu
