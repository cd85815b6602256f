#include "hold_back.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nearest_pair.h"

namespace tissu {
namespace {

constexpr double kLeast = 0.1;    ///< of xi
constexpr double kOfStart = 0.5;  ///< of the distance at the start
constexpr double kBall = 0.45;    ///< of the distance that is left
constexpr double kKept = 0.9;     ///< of the way to a plane

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

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

double HoldBack::least(double apart, double start) { return std::min(kLeast * apart, kOfStart * start); }

FreeWay free_way(const Candidate& candidate, ConstReals from, ConstReals to, ConstReals bends) {
  PairWay pair{candidate.kind, {}, {}};
  double longest = 0.0;
  for (int i = 0; i < vertices_of(candidate.kind); ++i) {
    const std::int32_t v = candidate.vertex[at(i)];
    pair.from[at(i)] = block(from, v);
    pair.way[at(i)] = block(to, v) - block(from, v);
    longest = std::max(longest, pair.way[at(i)].squaredNorm());
  }
  const double bend = bends.empty() ? 0.0 : bend_of(candidate, bends);
  if (longest == 0.0 && bend == 0.0) return {1.0, true};
  const double distance = std::sqrt(nearest_of(candidate.kind, pair.from).square);
  const double least = HoldBack::least(candidate.apart, distance);
  const double room = distance - least;
  // What arcs leave their chords by up to a share of the way: half of the room at most.
  const double most = bend > room ? std::max(0.0, room / bend) : 1.0;
  const double off = (most < 1.0 ? 0.5 * most : 0.125) * bend;
  if (most < 1.0) {
    for (Vec3& way : pair.way) way *= most;
    longest *= most * most;
  }
  if (std::sqrt(longest) <= kBall * (room - off) || is_kept_apart(pair, least + off)) {
    return {most, most == 1.0};
  }
  return {most * free_share(pair, least + off), false};
}

std::size_t HoldBack::root(std::int32_t vertex) const {
  std::int32_t v = vertex;
  while (parent_[at(v)] != v) v = parent_[at(v)] = parent_[at(parent_[at(v)])];
  return at(v);
}

void HoldBack::lower(std::int32_t vertex, double share) {
  double& of = shares_[root(vertex)];
  of = std::min(of, share);
}

void HoldBack::join(const Candidate& candidate, double share) {
  std::int32_t first = -1;
  for (const std::int32_t v : candidate.vertex) {
    if (v < 0 || given_[at(v)] != 0) continue;
    if (first < 0) {
      first = v;
      continue;
    }
    const std::size_t a = root(first);
    const std::size_t b = root(v);
    if (a == b) continue;
    const auto [low, high] = std::minmax(a, b);
    parent_[high] = static_cast<std::int32_t>(low);
    shares_[low] = std::min(shares_[low], shares_[high]);
  }
  if (first >= 0) lower(first, share);
}

bool HoldBack::find(const Candidates& candidates, std::span<const PlacedPlane> planes, ConstReals from,
                    ConstReals to, ConstReals bends) {
  const std::size_t count = surfaces_.vertices().size();
  parent_.resize(count);
  std::iota(parent_.begin(), parent_.end(), 0);
  for (const auto& surface : surfaces_.surfaces()) {
    if (surface.carrier < 0) continue;
    std::fill(parent_.begin() + surface.first_vertex, parent_.begin() + surface.last_vertex,
              surface.first_vertex);
  }
  shares_.assign(count, 1.0);
  stopped_.clear();
  stopped_at_planes_.clear();
  bool held = false;
  const auto& list = candidates.list();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (candidates.is_far(i, list[i].apart)) continue;
    const FreeWay way = free_way(list[i], from, to, bends);
    if (way.whatever) continue;
    join(list[i], way.share);
    if (way.share == 1.0) continue;
    held = true;
    stopped_.push_back(static_cast<std::int32_t>(i));
  }
  const auto& before_planes = candidates.planes();
  for (std::size_t i = 0; i < before_planes.size(); ++i) {
    const PlaneCandidate& c = before_planes[i];
    const PlacedPlane& plane = planes[at(c.obstacle)];
    const double start = plane.normal.dot(block(from, c.vertex) - plane.point);
    const double bend = bends.empty() ? 0.0 : 0.125 * bends[at(c.vertex)];
    const double end = plane.normal.dot(block(to, c.vertex) - plane.point) - bend;
    const double least = HoldBack::least(c.apart, std::max(start, 0.0));
    if (end >= least || end >= start || given_[at(c.vertex)] != 0) continue;
    lower(c.vertex, std::max(0.0, kKept * (start - least) / (start - end)));
    held = true;
    stopped_at_planes_.push_back(static_cast<std::int32_t>(i));
  }
  return held;
}

}  // namespace tissu
