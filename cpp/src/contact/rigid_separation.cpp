#include "rigid_separation.h"

#include <algorithm>
#include <cmath>

#include "nearest_pair.h"
#include "tissu/base/index.h"
#include "tissu/contact/closest.h"

namespace tissu {
namespace {

constexpr double kLeft = 1e-9;     ///< of the gap: what may be missing of it
constexpr double kTouch = 1e-9;    ///< of the distance at rest: nearer, a direction is round-off
constexpr int kSweeps = 64;        ///< times the square of the number of free obstacles, in a pile, …
constexpr int kMostSweeps = 8192;  ///< … no more than these

}  // namespace

RigidSeparation::RigidSeparation(const Contact& contact, const FixedDofs& fixed,
                                 std::span<const RowRange> loose, const State& start)
    : contact_(contact), start_(start) {
  const auto& surfaces = contact.surfaces().surfaces();
  const std::vector<std::uint8_t>& masks = fixed.masks();
  for (const RowRange& rows : loose) {
    const auto mask = masks.begin();
    if (std::any_of(mask + rows.first, mask + rows.last, [](std::uint8_t held) { return held != 0; }))
      continue;
    const auto own = std::ranges::find_if(surfaces, [&](const auto& surface) {
      return surface.obstacle < 0 && surface.first_row == rows.first;
    });
    if (own != surfaces.end()) loose_[static_cast<std::int32_t>(own - surfaces.begin())] = {rows};
  }
  movers_ = loose_.size() + contact.surfaces().carriers().size();
  has_any_ = movers_ > 0;
}

bool RigidSeparation::has(const Candidate& c) const {
  bool moves_any = false;
  bool loose = false;
  bool soft = false;
  for (int k = 0; k < vertices_of(c.kind); ++k) {
    const SurfaceVertex& vertex = contact_.surfaces().vertices()[at(c.vertex[at(k)])];
    const bool own = is_loose(vertex.surface);
    soft = soft || (vertex.is_soft() && !own);
    loose = loose || own;
    moves_any = moves_any || own || vertex.carrier >= 0;
  }
  const std::int32_t first = contact_.surfaces().vertices()[at(c.vertex[0])].surface;
  const std::int32_t second =
      contact_.surfaces().vertices()[at(c.vertex[at(vertices_of_first(c.kind))])].surface;
  return first != second && moves_any && (loose || !soft);
}

bool RigidSeparation::has(const PlaneCandidate& c) const {
  const SurfaceVertex& vertex = contact_.surfaces().vertices()[at(c.vertex)];
  return vertex.carrier >= 0 || is_loose(vertex.surface);
}

bool RigidSeparation::is_soft(const Candidate& c) const {
  for (int k = 0; k < vertices_of(c.kind); ++k) {
    if (contact_.surfaces().vertices()[at(c.vertex[at(k)])].is_soft()) return true;
  }
  return false;
}

bool RigidSeparation::run(Candidates& candidates, std::vector<double>& places, ConstReals normals) {
  bool any = false;
  while (true) {
    const Ways left = move_all(candidates, places, normals, any);
    bool stuck = false;
    for (const auto& [pair, way] : left) {
      for (const std::int32_t surface : {pair.first, pair.second}) {
        const auto found = loose_.find(surface);
        if (found == loose_.end()) continue;
        move(surface, -found->second.moved, places);
        loose_.erase(found);
        stuck = true;
      }
    }
    if (!stuck) return any;
  }
}

/// Gauss and Seidel: a pair finds what the pairs before it have moved in the same sweep.
RigidSeparation::Ways RigidSeparation::move_all(Candidates& candidates, std::vector<double>& places,
                                                ConstReals normals, bool& any) {
  const auto count = static_cast<int>(std::min<std::size_t>(movers_, 1000));
  const int most = std::min(kSweeps * count * count, kMostSweeps);
  std::vector<Vec3> moved(contact_.surfaces().surfaces().size());
  Ways asked;
  for (int i = 0; i < most; ++i) {
    candidates.cover(places, places);
    asked = ways(candidates, places, normals);
    if (asked.empty()) break;
    any = true;
    std::ranges::fill(moved, Vec3::Zero());
    for (const auto& [pair, way] : asked) {
      const Vec3 second = moves(pair.second) ? moved[at(pair.second)] : Vec3::Zero();
      const Vec3 first = moves(pair.first) ? moved[at(pair.first)] : Vec3::Zero();
      const double left = way.length - way.along.dot(first - second);
      const bool both = moves(pair.first) && moves(pair.second);
      const Vec3 by = (both ? 0.5 : 1.0) * std::max(0.0, left) * way.along;
      if (moves(pair.first)) moved[at(pair.first)] += by;
      if (moves(pair.second)) moved[at(pair.second)] -= by;
    }
    for (std::size_t s = 0; s < moved.size(); ++s) {
      if (!moved[s].isZero(0.0)) move(static_cast<std::int32_t>(s), moved[s], places);
    }
  }
  return asked;
}

/// The longest of each pair of surfaces.
RigidSeparation::Ways RigidSeparation::ways(const Candidates& candidates, ConstReals places,
                                            ConstReals normals) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  Ways all;
  const auto ask = [&](std::int32_t first, std::int32_t second, const Way& way) {
    if (!(way.length > 0.0)) return;
    Way& longest = all[{first, second}];
    if (way.length > longest.length) longest = way;
  };
  for (const PlaneCandidate& c : candidates.planes()) {
    if (!has(c)) continue;
    const auto plane = static_cast<std::int32_t>(contact_.description().bodies.size()) + c.obstacle;
    ask(surfaces.vertices()[at(c.vertex)].surface, plane, way_of(c, places));
  }
  for (const Candidate& c : candidates.list()) {
    if (!has(c)) continue;
    const std::int32_t first = surfaces.vertices()[at(c.vertex[0])].surface;
    const std::int32_t second = surfaces.vertices()[at(c.vertex[at(vertices_of_first(c.kind))])].surface;
    Way way = way_of(c, places, normals);
    if (second < first) way.along = -way.along;
    ask(std::min(first, second), std::max(first, second), way);
  }
  return all;
}

/// Along the way from the one to the other; where a vertex is behind a face by no more than the gap, back
/// through the face if it came from there.
RigidSeparation::Way RigidSeparation::way_of(const Candidate& c, ConstReals places,
                                             ConstReals normals) const {
  const double gap = std::min(contact_.description().pairs[at(c.pair)].gap, c.apart);
  std::array<Vec3, 4> p{};
  for (int k = 0; k < vertices_of(c.kind); ++k) p[at(k)] = block(places, c.vertex[at(k)]);
  const double room =
      gap + moved(contact_.surfaces().vertices()[at(c.vertex[0])].surface) +
      moved(contact_.surfaces().vertices()[at(c.vertex[at(vertices_of_first(c.kind))])].surface);
  const Closest closest = nearest_of(c.kind, p);
  const double d = std::sqrt(closest.square);
  const bool is_apart = d > c.apart - kLeft * gap;
  if (is_apart && (c.kind != PairKind::vertex_face || d > room)) return {};
  if (c.kind == PairKind::vertex_face) {
    const Vec3 n = (p[2] - p[1]).cross(p[3] - p[1]).normalized();
    const double s = n.dot(closest.r);
    if (s <= kTouch * c.apart) {
      const bool before = n.dot(block(normals, c.vertex[0])) < 0.0;
      const bool shallow = c.apart == gap && s >= -room;
      return before && shallow && n.allFinite() ? Way{c.apart - s, n} : Way{};
    }
  }
  if (is_apart || d < c.apart - gap - room || d < kTouch * c.apart) return {};
  // Edges of volumes that overlap would be led on through each other.
  if (c.kind != PairKind::vertex_face && c.apart == gap && is_soft(c)) return {};
  return {c.apart - d, closest.r / d};
}

RigidSeparation::Way RigidSeparation::way_of(const PlaneCandidate& c, ConstReals places) const {
  const double gap = contact_.description().pairs[at(c.pair)].gap;
  const Vec3 origin = contact_.place_of(c.obstacle, contact_.description().obstacles[at(c.obstacle)].origin,
                                        start_, start_.time);
  const Vec3 n = contact_.normal_of(c.obstacle, start_, start_.time);
  const double s = n.dot(block(places, c.vertex) - origin);
  const double room = gap + moved(contact_.surfaces().vertices()[at(c.vertex)].surface);
  if (s > c.apart - kLeft * gap || s < c.apart - gap - room) return {};
  return {c.apart - s, n};
}

bool RigidSeparation::moves(std::int32_t surface) const {
  const auto& surfaces = contact_.surfaces().surfaces();
  if (at(surface) >= surfaces.size()) return false;  // a plane
  return surfaces[at(surface)].carrier >= 0 || is_loose(surface);
}

double RigidSeparation::moved(std::int32_t surface) const {
  const auto found = loose_.find(surface);
  return found == loose_.end() ? 0.0 : found->second.moved.norm();
}

void RigidSeparation::move(std::int32_t surface, const Vec3& by, std::vector<double>& places) {
  const SurfaceSet& surfaces = contact_.surfaces();
  const auto& of = surfaces.surfaces()[at(surface)];
  const auto found = loose_.find(surface);
  if (found != loose_.end()) {
    found->second.moved += by;
    const RowRange& rows = found->second.rows;
    auto mover = static_cast<std::int32_t>(surfaces.vertices().size());
    for (const auto& inner : surfaces.inner_rows()) {
      if (inner.row >= rows.first && inner.row < rows.last) block(Reals(places), mover) += by;
      ++mover;
    }
  }
  for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) block(Reals(places), v) += by;
}

void RigidSeparation::move_rows(Reals positions) const {
  for (const auto& [surface, body] : loose_) {
    if (body.moved.isZero(0.0)) continue;
    for (std::int32_t row = body.rows.first; row < body.rows.last; ++row) block(positions, row) += body.moved;
  }
}

}  // namespace tissu
