/// Balls, rods and sheets that are led into what is held, or held things that are led into them.

#include <algorithm>
#include <cmath>

#include "nearest_pair.h"
#include "push_ahead.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kNothing = 1e-6;  ///< of the gap: round-off of what slides along

}  // namespace

bool PushAhead::find_held() const {
  const auto& obstacles = contact_.description().obstacles;
  const auto& vertices = contact_.surfaces().vertices();
  bool leads = false;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    leads = leads || contact_.carrier_of(static_cast<std::int32_t>(i)) == nullptr;
  }
  bool is_thick = false;
  bool is_held = false;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    is_thick = is_thick || vertices[v].radius > 0.0;
    is_held = is_held || (given_[v] != 0 && vertices[v].is_soft());
  }
  return leads && is_thick && is_held;
}

void PushAhead::measure_room(std::int32_t pair, double before, double after,
                             const std::array<std::int32_t, 2>& ends) {
  if (!meets_held_) return;
  Room& room = rooms_[at(pair)];
  room.before = std::min(room.before, before);
  if (after < room.after) {
    room.after = after;
    room.where = ends;
  }
}

void PushAhead::measure_room(const Candidate& candidate, ConstReals from) {
  const auto& vertices = contact_.surfaces().vertices();
  const std::int32_t first = candidate.vertex[0];
  const std::int32_t other = candidate.vertex[at(vertices_of_first(candidate.kind))];
  const double thickness = vertices[at(first)].radius + vertices[at(other)].radius;
  if (thickness == 0.0 || vertices[at(first)].is_free() == vertices[at(other)].is_free()) return;
  std::array<Vec3, 4> before{};
  std::array<Vec3, 4> after{};
  for (int k = 0; k < vertices_of(candidate.kind); ++k) {
    const std::int32_t v = candidate.vertex[at(k)];
    if (given_[at(v)] == 0) return;
    before[at(k)] = block(from, v);
    after[at(k)] = block(ConstReals(to_), v);
  }
  const auto distance = [&](const std::array<Vec3, 4>& p) {
    return std::sqrt(nearest_of(candidate.kind, p).square) - thickness;
  };
  measure_room(candidate.pair, distance(before), distance(after), {first, other});
}

/// What slides along in a dent as deep as before is let go on.
bool PushAhead::is_led_into_held() {
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    const Room& room = rooms_[i];
    const double gap = contact_.description().pairs[i].gap;
    const bool deep = room.after < -gap && room.after < room.before;
    if (!deep && !(room.after < 0.0 && room.before - room.after > kNothing * gap)) continue;
    is_led_in_ = true;
    culprit_ = room.where[0];
    other_ = room.where[1];
    return true;
  }
  return false;
}

}  // namespace tissu
