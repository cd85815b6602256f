#include "push_ahead.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "nearest_pair.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr int kRounds = 32;
constexpr int kMostParts = 64;
constexpr double kPartOfEdge = 0.5;
constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kLeastFree = 0.1;  ///< of the weights of a vertex: less of it does not move it

}  // namespace

PushAhead::PushAhead(const Contact& contact, const std::vector<std::uint8_t>& given)
    : contact_(contact), given_(given) {
  part_ = std::numeric_limits<double>::infinity();
  const SurfaceSet& surfaces = contact.surfaces();
  for (std::size_t s = 0; s < surfaces.surfaces().size(); ++s) {
    const SurfaceSet::Surface& of = surfaces.surfaces()[s];
    if (of.obstacle >= 0 && of.carrier < 0) continue;
    double edge = surfaces.mean_edge(static_cast<std::int32_t>(s));
    if (edge == 0.0 && of.carrier >= 0) edge = 2.0 * surfaces.vertices()[at(of.first_vertex)].radius;
    if (edge > 0.0) part_ = std::min(part_, kPartOfEdge * edge);
  }
  meets_held_ = find_held();
  if (meets_held_) rooms_.reserve(contact.description().pairs.size());
}

void PushAhead::lead(const LedMotion& motion, double share, Reals places) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  const double time = share == 1.0 ? motion.to : motion.from + share * (motion.to - motion.from);
  const auto lead_row = [&](std::size_t mover, std::int32_t row) {
    const Vec3 from = block(ConstReals(motion.state.positions), row);
    const Vec3 to = block(motion.end, row);
    block(places, static_cast<std::int32_t>(mover)) = share == 1.0 ? to : Vec3(from + share * (to - from));
  };
  const auto& vertices = surfaces.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (given_[v] == 0) continue;
    const auto number = static_cast<std::int32_t>(v);
    const SurfaceVertex& vertex = vertices[v];
    if (vertex.row >= 0) {
      lead_row(v, vertex.row);
    } else if (vertex.rider < 0) {
      const std::int32_t obstacle = surfaces.surfaces()[at(vertex.surface)].obstacle;
      block(places, number) =
          contact_.place_of(obstacle, block(ConstReals(surfaces.rest()), number), motion.state, time);
    }
  }
  if (!surfaces.has_riders()) return;
  const auto& inner = surfaces.inner_rows();
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (given_[vertices.size() + i] != 0) lead_row(vertices.size() + i, inner[i].row);
  }
  place_riders(motion, share, places);
}

void PushAhead::place_riders(const LedMotion& motion, double share, Reals places) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  if (!surfaces.has_turning_riders() || share == 1.0) {
    surfaces.place_riders(places, motion.turned);
    return;
  }
  std::vector<Quaternion> turned = motion.state.rotations;
  for (const SurfaceRotation& of : surfaces.rotations()) {
    Quaternion& now = turned[at(of.frame)];
    const Vec3 whole = nearest_turn(motion.turned[at(of.frame)] * now.conjugate(), Vec3::Zero());
    now = turn_by(share * whole) * now;
  }
  surfaces.place_riders(places, turned);
}

void PushAhead::place_planes(const LedMotion& motion, double share, std::vector<PlacedPlane>& planes) const {
  const auto& obstacles = contact_.description().obstacles;
  const double time = share == 1.0 ? motion.to : motion.from + share * (motion.to - motion.from);
  planes.resize(obstacles.size());
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!obstacles[i].plane) continue;
    const auto number = static_cast<std::int32_t>(i);
    planes[i] = {contact_.place_of(number, obstacles[i].origin, motion.state, time),
                 contact_.normal_of(number, motion.state, time)};
  }
}

double PushAhead::parts_of(const LedMotion& motion) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  double way = 0.0;
  for (std::size_t v = 0; v < surfaces.vertices().size(); ++v) {
    const SurfaceVertex& vertex = surfaces.vertices()[v];
    if (vertex.is_free()) continue;
    const std::int32_t obstacle = surfaces.surfaces()[at(vertex.surface)].obstacle;
    const Vec3 rest = block(ConstReals(surfaces.rest()), static_cast<std::int32_t>(v));
    way = std::max(way, (contact_.place_of(obstacle, rest, motion.state, motion.to) -
                         contact_.place_of(obstacle, rest, motion.state, motion.from))
                            .norm());
  }
  std::vector<PlacedPlane> first;
  std::vector<PlacedPlane> last;
  place_planes(motion, 0.0, first);
  place_planes(motion, 1.0, last);
  for (std::size_t i = 0; i < last.size(); ++i) {
    if (!contact_.description().obstacles[i].plane) continue;
    way = std::max(
        {way, (last[i].point - first[i].point).norm(), (last[i].normal - first[i].normal).norm() * part_});
  }
  return way / part_;
}

void PushAhead::push(const LedMotion& motion, Candidates& candidates, std::vector<double>& places,
                     std::vector<PlacedPlane>& planes) {
  to_ = places;
  lead(motion, 1.0, to_);
  double longest = 0.0;
  for (std::size_t i = 0; i < places.size(); i += 3) {
    const auto v = static_cast<std::int32_t>(i / 3);
    longest = std::max(longest, (block(ConstReals(to_), v) - block(ConstReals(places), v)).squaredNorm());
  }
  place_planes(motion, 0.0, planes);
  const std::vector<PlacedPlane>& first = planes;
  double way = std::sqrt(longest);
  std::vector<PlacedPlane>& last = last_;
  place_planes(motion, 1.0, last);
  for (std::size_t i = 0; i < last.size(); ++i) {
    if (!contact_.description().obstacles[i].plane) continue;
    way = std::max(
        {way, (last[i].point - first[i].point).norm(), (last[i].normal - first[i].normal).norm() * part_});
  }
  planes = last;
  if (way == 0.0) return;
  if (way > kMostParts * part_) refuse(motion, way);
  const int least = std::max(1, static_cast<int>(std::ceil(way / part_)));
  begin_ = places;
  for (int parts = least; parts <= kMostParts; parts *= 2) {
    places = begin_;
    bool done = true;
    for (int i = 0; done && i < parts; ++i) {
      done =
          go(motion, static_cast<double>(i) / parts, static_cast<double>(i + 1) / parts, candidates, places);
    }
    if (done) return;
    if (is_led_in_) break;
  }
  refuse(motion, way);
}

bool PushAhead::go(const LedMotion& motion, double before, double after, Candidates& candidates,
                   std::vector<double>& places) {
  to_ = places;
  lead(motion, after, to_);
  is_led_in_ = false;
  if (meets_held_) rooms_.assign(contact_.description().pairs.size(), {kFar, kFar, {-1, -1}});
  for (int round = 0; round < kRounds; ++round) {
    candidates.cover(places, to_);
    bool pushed = false;
    bool clear = push_pairs(candidates, places, pushed);
    clear = push_before_planes(motion, before, after, candidates, places, pushed) && clear;
    if (meets_held_ && is_led_into_held()) return false;
    if (clear) {
      places = to_;
      return true;
    }
    if (!pushed) return false;
  }
  return false;
}

/// A rigid body goes as a whole, and what rows carry goes with them.
void PushAhead::move(std::int32_t vertex, const Vec3& by) {
  const SurfaceSet& surfaces = contact_.surfaces();
  const SurfaceVertex& of = surfaces.vertices()[at(vertex)];
  if (of.rider >= 0) {
    double free = 0.0;
    for (const RiderPart& part : surfaces.parts(of)) {
      if (given_[at(part.mover)] == 0) free += part.weight;
    }
    if (free < kLeastFree) return;
    for (const RiderPart& part : surfaces.parts(of)) {
      if (given_[at(part.mover)] == 0) move_row(part.mover, by / free);
    }
    return;
  }
  if (of.carrier < 0) {
    move_row(vertex, by);
    return;
  }
  const auto& surface = surfaces.surfaces()[at(of.surface)];
  for (std::int32_t v = surface.first_vertex; v < surface.last_vertex; ++v) block(Reals(to_), v) += by;
}

void PushAhead::move_row(std::int32_t mover, const Vec3& by) {
  block(Reals(to_), mover) += by;
  if (!contact_.surfaces().has_riders()) return;
  for (const auto& carried : contact_.surfaces().carried_by(mover)) {
    block(Reals(to_), carried.vertex) += carried.weight * by;
  }
}

/// True when all pairs keep apart; else `pushed` says whether something was moved out of the way.
bool PushAhead::push_pairs(const Candidates& candidates, ConstReals from, bool& pushed) {
  bool clear = true;
  for (const std::int32_t number : candidates.near()) {
    const std::size_t i = at(number);
    const Candidate& candidate = candidates.list()[i];
    if (candidates.is_far(i, candidate.apart)) continue;
    const FreeWay way = free_way(candidate, from, to_, {});
    if (meets_held_) measure_room(candidate, from);
    if (way.share == 1.0) continue;
    clear = false;
    culprit_ = candidate.vertex[0];
    other_ = candidate.vertex[at(vertices_of_first(candidate.kind))];
    std::array<Vec3, 4> p{};
    const int count = vertices_of(candidate.kind);
    const int first = vertices_of_first(candidate.kind);
    for (int k = 0; k < count; ++k) p[at(k)] = block(from, candidate.vertex[at(k)]);
    const Closest closest = nearest_of(candidate.kind, p);
    std::array<Vec3, 2> moved = {Vec3::Zero(), Vec3::Zero()};
    for (int k = 0; k < count; ++k) {
      const std::int32_t v = candidate.vertex[at(k)];
      moved[k < first ? 0 : 1] +=
          std::abs(closest.beta[at(k)]) * (block(ConstReals(to_), v) - block(from, v));
    }
    const int pusher = moved[0].squaredNorm() >= moved[1].squaredNorm() ? 0 : 1;
    for (int k = 0; k < count; ++k) {
      const std::int32_t v = candidate.vertex[at(k)];
      if ((k < first ? 0 : 1) == pusher || given_[at(v)] != 0) continue;
      const Vec3 now = block(ConstReals(to_), v) - block(from, v);
      if (now.squaredNorm() >= moved[at(pusher)].squaredNorm()) continue;
      move(v, block(from, v) + moved[at(pusher)] - block(ConstReals(to_), v));
      pushed = true;
    }
  }
  return clear;
}

bool PushAhead::push_before_planes(const LedMotion& motion, double before, double after,
                                   const Candidates& candidates, ConstReals from, bool& pushed) {
  if (candidates.planes().empty()) return true;
  std::vector<PlacedPlane> first;
  std::vector<PlacedPlane> last;
  place_planes(motion, before, first);
  place_planes(motion, after, last);
  bool clear = true;
  for (const PlaneCandidate& c : candidates.planes()) {
    const PlacedPlane& was = first[at(c.obstacle)];
    const PlacedPlane& is = last[at(c.obstacle)];
    const double start = was.normal.dot(block(from, c.vertex) - was.point);
    const double end = is.normal.dot(block(ConstReals(to_), c.vertex) - is.point);
    const double least = HoldBack::least(c.apart, std::max(start, 0.0));
    const double radius = contact_.surfaces().vertices()[at(c.vertex)].radius;
    if (radius > 0.0 && given_[at(c.vertex)] != 0) {
      measure_room(c.pair, start - radius, end - radius, {c.vertex, -1});
    }
    if (end >= least || end >= start) continue;
    culprit_ = c.vertex;
    other_ = -1;
    clear = false;
    if (given_[at(c.vertex)] != 0) continue;
    move(c.vertex, (start - end) * is.normal);
    pushed = true;
  }
  return clear;
}

void PushAhead::refuse(const LedMotion& motion, double way) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  const auto name = [&](std::int32_t vertex) {
    return "\"" + surfaces.surfaces()[at(surfaces.vertices()[at(vertex)].surface)].name + "\"";
  };
  const double h = motion.to - motion.from;
  std::string message = "in the step from t = " + number_text(motion.from) +
                        " s with dt = " + number_text(h) + " s something is led " + number_text(way) +
                        " m, at " + number_text(way / h) + " m/s";
  if (way > kMostParts * part_) {
    message += "; at most " + number_text(kMostParts * part_) +
               " m a step are accepted. Take dt = " + number_text(0.5 * h * kMostParts * part_ / way) +
               " s or less, or lead it more slowly.";
  } else {
    const bool alone = culprit_ >= 0 && other_ >= 0 && name(culprit_) == name(other_);
    message += alone ? ", and leaves no room between parts" : ", and leaves no room";
    if (culprit_ >= 0) message += (alone ? " of " : " for ") + name(culprit_);
    if (other_ >= 0 && !alone) message += " and " + name(other_);
    message += ". Lead it elsewhere, or more slowly, so that what it pushes can give way.";
  }
  const std::string body =
      culprit_ >= 0 ? surfaces.surfaces()[at(surfaces.vertices()[at(culprit_)].surface)].name : "";
  throw Diverged(message, body, -1, motion.from);
}

}  // namespace tissu
