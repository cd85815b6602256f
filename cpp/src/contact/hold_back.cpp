#include "hold_back.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kOfStart = 0.5;   ///< of the distance at the start
constexpr double kBall = 0.45;     ///< of the distance that is left
constexpr double kKept = 0.9;      ///< of the way to a plane
constexpr double kNearest = 1e-9;  ///< of xi: nearer, nothing goes on to a plane, lest it ends in round-off

/// Of both sides together.
double bend_of(const Candidate& candidate, ConstReals bends) {
  std::array<double, 2> sides = {};
  for (int i = 0; i < vertices_of(candidate.kind); ++i) {
    double& side = sides[i < vertices_of_first(candidate.kind) ? 0 : 1];
    side = std::max(side, bends[at(candidate.vertex[at(i)])]);
  }
  return sides[0] + sides[1];
}

}  // namespace

double HoldBack::least(double apart, double start, double kept) {
  return std::min(kept * apart, std::max(kOfStart, kept) * start);
}

FreeWay free_way(const Candidate& candidate, ConstReals from, ConstReals to, ConstReals bends,
                 ConstReals sways) {
  PairWay pair{candidate.kind, {}, {}};
  double longest = 0.0;
  for (int i = 0; i < vertices_of(candidate.kind); ++i) {
    const std::int32_t v = candidate.vertex[at(i)];
    pair.from[at(i)] = block(from, v);
    pair.way[at(i)] = block(to, v) - block(from, v);
    longest = std::max(longest, pair.way[at(i)].squaredNorm());
  }
  const double bend = bends.empty() ? 0.0 : bend_of(candidate, bends);
  const double sway = sways.empty() ? 0.0 : bend_of(candidate, sways);
  if (longest == 0.0 && bend == 0.0 && sway == 0.0) return {1.0, true};
  const Vec3 start = shortest_line(pair);
  const double distance = start.norm();
  const double least = HoldBack::least(candidate.apart, distance, candidate.kept);
  const double room = distance - least;
  // What arcs leave their chords by up to a share of the way: half of the room at most.
  const double most = bend > room ? std::max(0.0, room / bend) : 1.0;
  const double off = (most < 1.0 ? 0.5 * most : 0.125) * bend;
  if (most < 1.0) {
    for (Vec3& way : pair.way) way *= most;
    longest *= most * most;
  }
  if (std::sqrt(longest) <= kBall * (room - off - sway) || is_kept_apart(pair, start, least + off + sway)) {
    return {most, most == 1.0};
  }
  return {most * free_share(pair, start, least + off), false};
}

std::size_t HoldBack::root(std::int32_t mover) const {
  std::int32_t m = mover;
  while (parent_[at(m)] != m) m = parent_[at(m)] = parent_[at(parent_[at(m)])];
  return at(m);
}

/// `first`: a mover of the island; -1: none yet.
void HoldBack::join(std::int32_t& first, std::int32_t mover) {
  if (given_[at(mover)] != 0) return;
  if (first < 0) {
    first = mover;
    return;
  }
  const std::size_t a = root(first);
  const std::size_t b = root(mover);
  if (a == b) return;
  const auto [low, high] = std::minmax(a, b);
  parent_[high] = static_cast<std::int32_t>(low);
  shares_[low] = std::min(shares_[low], shares_[high]);
  anchored_[low] = std::max(anchored_[low], anchored_[high]);
}

void HoldBack::join(std::span<const std::int32_t> vertices, double share, bool before_plane) {
  std::int32_t first = -1;
  bool given = before_plane;
  const auto add = [&](std::int32_t mover) {
    given = given || given_[at(mover)] != 0;
    join(first, mover);
  };
  for (const std::int32_t v : vertices) {
    if (v < 0) continue;
    const SurfaceVertex& vertex = surfaces_.vertices()[at(v)];
    if (vertex.rider < 0) {
      add(v);
      continue;
    }
    for (const RiderPart& part : surfaces_.parts(vertex)) add(part.mover);
  }
  if (first < 0) return;
  const std::size_t of = root(first);
  shares_[of] = std::min(shares_[of], share);
  if (given && share < 1.0) anchored_[of] = 1;
}

void HoldBack::release() {
  const std::size_t count = surfaces_.mover_count();
  parent_.resize(count);
  std::iota(parent_.begin(), parent_.end(), 0);
  shares_.assign(count, 1.0);
  anchored_.assign(count, 0);
  forget();
}

bool HoldBack::find(const Candidates& candidates, std::span<const PlacedPlane> planes, ConstReals from,
                    ConstReals to, ConstReals bends, ConstReals sways) {
  release();
  for (const auto& surface : surfaces_.surfaces()) {
    if (surface.carrier < 0) continue;
    std::fill(parent_.begin() + surface.first_vertex, parent_.begin() + surface.last_vertex,
              surface.first_vertex);
  }
  bool held = false;
  const auto& list = candidates.list();
  for (const std::int32_t number : candidates.near()) {
    const std::size_t i = at(number);
    if (candidates.is_far(i, list[i].apart)) continue;
    const FreeWay way = free_way(list[i], from, to, bends, sways);
    if (way.whatever) continue;
    join(list[i].vertex, way.share);
    if (way.share == 1.0) continue;
    held = true;
    stopped_.push_back(number);
  }
  const auto& before_planes = candidates.planes();
  for (std::size_t i = 0; i < before_planes.size(); ++i) {
    const PlacedPlane& plane = planes[at(before_planes[i].obstacle)];
    const FreeWay way = free_way_to_plane(before_planes[i], plane, from, to, bends, sways);
    if (way.whatever) continue;
    join({&before_planes[i].vertex, 1}, way.share, true);
    if (way.share == 1.0) continue;
    held = true;
    stopped_at_planes_.push_back(static_cast<std::int32_t>(i));
  }
  return held;
}

std::vector<Candidate> HoldBack::stopped_pairs(const Candidates& candidates) const {
  std::vector<Candidate> pairs;
  pairs.reserve(stopped_.size());
  for (const std::int32_t number : stopped_) pairs.push_back(candidates.list()[at(number)]);
  return pairs;
}

void HoldBack::stop_again(const Candidates& candidates, std::vector<Candidate> pairs) {
  const auto key = [](const Candidate& c) { return std::tuple(c.kind, c.a, c.b); };
  std::ranges::sort(pairs, {}, key);
  stopped_.clear();
  for (const std::int32_t number : candidates.near()) {
    if (std::ranges::binary_search(pairs, key(candidates.list()[at(number)]), {}, key)) {
      stopped_.push_back(number);
    }
  }
}

bool HoldBack::is_free(const Candidates& candidates, std::span<const PlacedPlane> planes, ConstReals from,
                       ConstReals to, ConstReals bends, ConstReals sways) const {
  const auto& list = candidates.list();
  const auto is_pair_free = [&](std::int32_t i) {
    return candidates.is_far(at(i), list[at(i)].apart) ||
           free_way(list[at(i)], from, to, bends, sways).share == 1.0;
  };
  const auto is_free_of_plane = [&](const PlaneCandidate& c) {
    return free_way_to_plane(c, planes[at(c.obstacle)], from, to, bends, sways).share == 1.0;
  };
  return std::ranges::all_of(candidates.planes(), is_free_of_plane) &&
         std::ranges::all_of(candidates.near(), is_pair_free);
}

/// At a share s of its way, a vertex on an arc is off the chord by |arm| theta^2 s (1 - s) / 2 at most, which
/// is below an eighth of |arm| theta^2, and below half of it times s. Other pairs may cut the way at any s.
FreeWay HoldBack::free_way_to_plane(const PlaneCandidate& c, const PlacedPlane& plane, ConstReals from,
                                    ConstReals to, ConstReals bends, ConstReals sways) const {
  const double start = plane.normal.dot(block(from, c.vertex) - plane.point);
  const double end = plane.normal.dot(block(to, c.vertex) - plane.point);
  const double bend = bends.empty() ? 0.0 : bends[at(c.vertex)];
  const double least = start < kNearest * c.apart ? start : HoldBack::least(c.apart, start);
  const double sway = sways.empty() ? 0.0 : sways[at(c.vertex)];
  if (given_[at(c.vertex)] != 0 || std::min(start, end) - 0.125 * bend - sway >= least) return {1.0, true};
  const double falls = start - end + 0.5 * bend;
  if (falls <= 0.0 || start - falls >= least) return {1.0, sway == 0.0};
  return {std::max(0.0, kKept * (start - least) / falls), false};
}

}  // namespace tissu
