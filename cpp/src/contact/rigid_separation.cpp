#include "rigid_separation.h"

#include <algorithm>
#include <cmath>

#include "nearest_pair.h"
#include "tissu/contact/closest.h"

namespace tissu {
namespace {

constexpr double kLeft = 1e-9;     ///< of the gap: what may be missing of it
constexpr double kTouch = 1e-9;    ///< of the distance at rest: nearer, a direction is round-off
constexpr int kSweeps = 64;        ///< times the square of the number of free obstacles, in a pile, …
constexpr int kMostSweeps = 8192;  ///< … no more than these

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

RigidSeparation::RigidSeparation(const Contact& contact, const State& start)
    : contact_(contact), start_(start) {}

bool RigidSeparation::is_rigid(const SurfaceSet& surfaces, const Candidate& c) {
  bool carried = false;
  for (int k = 0; k < vertices_of(c.kind); ++k) {
    const SurfaceVertex& vertex = surfaces.vertices()[at(c.vertex[at(k)])];
    if (vertex.is_soft()) return false;
    carried = carried || vertex.carrier >= 0;
  }
  return carried;
}

bool RigidSeparation::is_rigid(const SurfaceSet& surfaces, const PlaneCandidate& c) {
  return surfaces.vertices()[at(c.vertex)].carrier >= 0;
}

/// Gauss and Seidel: a pair finds what the pairs before it have moved in the same sweep.
bool RigidSeparation::run(Candidates& candidates, std::vector<double>& places, ConstReals normals) const {
  const auto count = static_cast<int>(std::min<std::size_t>(contact_.surfaces().carriers().size(), 1000));
  const int most = std::min(kSweeps * count * count, kMostSweeps);
  std::vector<Vec3> moved(contact_.surfaces().surfaces().size());
  bool any = false;
  for (int i = 0; i < most; ++i) {
    candidates.cover(places, places);
    const Ways asked = ways(candidates, places, normals);
    if (asked.empty()) return any;
    any = true;
    std::ranges::fill(moved, Vec3::Zero());
    for (const auto& [pair, way] : asked) {
      const double left = way.length - way.along.dot(moved[at(pair.first)] - moved[at(pair.second)]);
      const bool both = is_free(pair.first) && is_free(pair.second);
      const Vec3 by = (both ? 0.5 : 1.0) * std::max(0.0, left) * way.along;
      if (is_free(pair.first)) moved[at(pair.first)] += by;
      if (is_free(pair.second)) moved[at(pair.second)] -= by;
    }
    for (std::size_t s = 0; s < moved.size(); ++s) {
      if (!moved[s].isZero(0.0)) move(static_cast<std::int32_t>(s), moved[s], places);
    }
  }
  return any;
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
    if (!is_rigid(surfaces, c)) continue;
    const auto plane = static_cast<std::int32_t>(contact_.description().bodies.size()) + c.obstacle;
    ask(surfaces.vertices()[at(c.vertex)].surface, plane, way_of(c, places));
  }
  for (const Candidate& c : candidates.list()) {
    if (!is_rigid(surfaces, c)) continue;
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
  const Closest closest = nearest_of(c.kind, p);
  const double d = std::sqrt(closest.square);
  if (d > c.apart - kLeft * gap) return {};
  if (c.kind == PairKind::vertex_face) {
    const Vec3 n = (p[2] - p[1]).cross(p[3] - p[1]).normalized();
    const double s = n.dot(closest.r);
    if (s <= kTouch * c.apart) {
      const bool before = n.dot(block(normals, c.vertex[0])) < 0.0;
      const bool shallow = c.apart == gap && s >= -gap;
      return before && shallow && n.allFinite() ? Way{c.apart - s, n} : Way{};
    }
  }
  if (d < c.apart - 2.0 * gap || d < kTouch * c.apart) return {};
  return {c.apart - d, closest.r / d};
}

RigidSeparation::Way RigidSeparation::way_of(const PlaneCandidate& c, ConstReals places) const {
  const double gap = contact_.description().pairs[at(c.pair)].gap;
  const Vec3 origin = contact_.place_of(c.obstacle, contact_.description().obstacles[at(c.obstacle)].origin,
                                        start_, start_.time);
  const Vec3 n = contact_.normal_of(c.obstacle, start_, start_.time);
  const double s = n.dot(block(places, c.vertex) - origin);
  if (s > c.apart - kLeft * gap || s < c.apart - 2.0 * gap) return {};
  return {c.apart - s, n};
}

bool RigidSeparation::is_free(std::int32_t surface) const {
  const auto& surfaces = contact_.surfaces().surfaces();
  return surfaces[at(surface)].carrier >= 0;
}

void RigidSeparation::move(std::int32_t surface, const Vec3& by, Reals places) const {
  const auto& of = contact_.surfaces().surfaces()[at(surface)];
  for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) block(places, v) += by;
}

}  // namespace tissu
