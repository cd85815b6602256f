/// What the latest look finds, and what it takes over from the contacts before it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "flat_edges.h"
#include "hold_back.h"
#include "narrow.h"
#include "nearest_pair.h"
#include "push_ahead.h"
#include "round.h"
#include "tissu/base/index.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/contact_run.h"

namespace tissu {
namespace {

ContactNumbers contact_of(const Found& found, std::int32_t point) {
  ContactNumbers c;
  c.kind = static_cast<double>(found.kind);
  c.a = found.a;
  c.b = found.b;
  c.point = point;
  return c;
}

bool is_of_vertex(const ContactNumbers& c) {
  return c.kind != ContactNumbers::kPlane && c.point == 0.0 &&
         c.kind != static_cast<double>(PairKind::edge_edge);
}

}  // namespace

/// Whether the latest contacts have one of this key, which acts.
const ContactNumbers* ContactRun::acting(const ContactNumbers& c) const {
  const auto found =
      std::ranges::lower_bound(order_, c.key(), {}, [&](std::int32_t i) { return contacts_[at(i)].key(); });
  if (found == order_.end() || contacts_[at(*found)].key() != c.key()) return nullptr;
  return &contacts_[at(*found)];
}

/// Whether it presses, and is to be found wherever it is: the place of a look may be out of reach, where a
/// free flight or a system with a force that is too large leads it, and the next system leads it back.
bool ContactRun::is_held_on(const ContactNumbers& c) const {
  if (!holds_on_) return false;
  const ContactNumbers* found = acting(c);
  return found != nullptr && found->force > 0.0;
}

/// The same of any point of a candidate.
bool ContactRun::is_held_on(const Candidate& candidate) const {
  if (!holds_on_) return false;
  ContactNumbers c;
  c.kind = static_cast<double>(candidate.kind);
  c.a = candidate.a;
  c.b = candidate.b;
  const auto key_of = [&](std::int32_t i) { return contacts_[at(i)].key(); };
  for (auto i = std::ranges::lower_bound(order_, c.key(), {}, key_of); i != order_.end(); ++i) {
    const ContactNumbers& other = contacts_[at(*i)];
    if (other.kind != c.kind || other.a != c.a || other.b != c.b) return false;
    if (other.force > 0.0) return true;
  }
  return false;
}

/// The nearest points inside both parts of a candidate, whatever the narrow phase's rules say of them.
bool ContactRun::find_plainly(const Candidate& candidate, double reach, Found& found) const {
  std::array<Vec3, 4> p{};
  for (int i = 0; i < vertices_of(candidate.kind); ++i) {
    p[at(i)] = block(ConstReals(now_), candidate.vertex[at(i)]);
  }
  const Closest closest = nearest_of(candidate.kind, p);
  if (!(closest.square < reach * reach) || !(closest.square > 0.0)) return false;
  // The ends of edges and the corners and edges of faces are parts of their own, by those rules.
  const auto count = static_cast<std::size_t>(vertices_of(candidate.kind));
  const bool at_end =
      std::any_of(closest.beta.begin(), closest.beta.begin() + count, [](double b) { return b == 0.0; });
  if (at_end && !every_pair_) return false;
  const SurfaceSet& surfaces = contact_.surfaces();
  if (is_of_flat(surfaces, candidate)) return false;
  if (candidate.kind == PairKind::vertex_face && is_before_neighbour(surfaces, now_, candidate, reach)) {
    return false;
  }
  double weight = 1.0;
  if (candidate.kind == PairKind::edge_edge) {
    weight = weight_of_edges(surfaces, every_pair_ ? from_ : now_, candidate.a, candidate.b);
  }
  found = {candidate.kind,
           candidate.a,
           candidate.b,
           candidate.vertex,
           closest.beta,
           closest.r,
           std::sqrt(closest.square),
           weight,
           0.0};
  return weight > 0.0;
}

void ContactRun::find() {
  looked_.clear();
  gaps_.clear();
  weights_.clear();
  predicted_.clear();
  order_.resize(contacts_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::sort(order_, {}, [&](std::int32_t i) { return contacts_[at(i)].key(); });
  find_pairs();
  find_planes();
}

/// Beside what the narrow phase finds, pairs that stopped a way, and pairs that act already: the linear
/// answer would lead through them.
void ContactRun::find_pairs() {
  const auto& pairs = contact_.description().pairs;
  Found found{};
  auto stopped = held_->stopped().begin();
  const Candidates& candidates = near();
  for (const std::int32_t number : candidates.near()) {
    const std::size_t i = at(number);
    const Candidate& candidate = candidates.list()[i];
    const double near_enough = candidate.apart + pairs[at(candidate.pair)].gap;
    const bool held_on = is_held_on(candidate);
    double reach = held_on ? std::numeric_limits<double>::infinity() : near_enough;
    const bool stops = stopped != held_->stopped().end() && at(*stopped) == i;
    if (stops) {
      reach = std::numeric_limits<double>::infinity();
      ++stopped;
    }
    if (candidates.is_far(i, reach)) continue;
    if (every_pair_) {
      if (find_plainly(candidate, reach, found)) add(candidate, found, 0);
      continue;
    }
    const int parts = parts_before_round(contact_.surfaces(), candidate);
    if (parts > 0 && !stops) {
      RoundPoints points(contact_.surfaces(), now_, from_, candidate, parts);
      while (points.next(reach, found)) {
        if (found.distance < near_enough || is_held_on(contact_of(found, points.number()))) {
          add(candidate, found, points.number());
        }
      }
      continue;
    }
    if (!find_contact(contact_.surfaces(), now_, candidate, reach, found)) {
      ContactNumbers c;
      c.kind = static_cast<double>(candidate.kind);
      c.a = candidate.a;
      c.b = candidate.b;
      if (!plainly_ || !(stops || acting(c) != nullptr)) continue;
      if (!find_plainly(candidate, reach, found)) continue;
    }
    add(candidate, found, 0);
  }
}

void ContactRun::add(const Candidate& candidate, const Found& found, std::int32_t point) {
  const auto& vertices = contact_.surfaces().vertices();
  ContactNumbers c = contact_of(found, point);
  c.pair = candidate.pair;
  Vec3 fixed = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    c.vertex[k] = found.vertex[k];
    c.beta[k] = found.vertex[k] < 0 ? 0.0 : found.beta[k];
    if (found.vertex[k] < 0 || vertices[at(found.vertex[k])].is_free()) continue;
    fixed += c.beta[k] * block(ConstReals(now_), found.vertex[k]);
  }
  c.normal = numbers_of(found.r / found.distance);
  c.fixed = numbers_of(fixed);
  set_offsets(c);
  c.place = numbers_of(found.r);
  c.apart = candidate.apart;
  c.area = found.area;
  looked_.push_back(c);
  predicted_.push_back(vector_of(c.normal).dot(reach(c, goal_)) < candidate.apart ? 1 : 0);
  gaps_.push_back(found.distance - candidate.apart);
  weights_.push_back(found.weight);
}

/// Where round things that rigid bodies carry, or that turn with frames, touch.
void ContactRun::set_offsets(ContactNumbers& c) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  if (!surfaces.has_rolling()) return;
  for (std::size_t k = 0; k < 4; ++k) {
    if (c.vertex[k] < 0.0) continue;
    const SurfaceVertex& vertex = surfaces.vertices()[static_cast<std::size_t>(c.vertex[k])];
    const std::int32_t frame = contact_.frame_of(c, vertex);
    if (frame < 0 || vertex.radius == 0.0) continue;
    const Vec3 own = looked_at_->rotations[at(frame)].conjugate() * contact_.outward(c, k);
    std::ranges::copy(numbers_of(own), c.offset.begin() + static_cast<std::ptrdiff_t>(3 * k));
  }
}

void ContactRun::find_planes() {
  const auto& vertices = contact_.surfaces().vertices();
  const auto& pairs = contact_.description().pairs;
  for (const PlaneCandidate& candidate : candidates_->planes()) {
    const PlacedPlane& plane = planes_[at(candidate.obstacle)];
    const Vec3 place = block(ConstReals(now_), candidate.vertex);
    const double distance = plane.normal.dot(place - plane.point);
    const double goal = plane.normal.dot(block(ConstReals(goal_), candidate.vertex) - plane.point);
    ContactNumbers c;
    c.kind = ContactNumbers::kPlane;
    c.a = candidate.vertex;
    c.b = candidate.obstacle;
    const bool is_near = std::min(distance, goal) < candidate.apart + pairs[at(candidate.pair)].gap;
    if (!is_near && !is_held_on(c)) continue;
    c.pair = candidate.pair;
    c.vertex[0] = candidate.vertex;
    c.beta[0] = 1.0;
    const Vec3 r = distance * plane.normal;
    c.normal = numbers_of(plane.normal);
    c.fixed = numbers_of(r - place);
    set_offsets(c);
    c.place = numbers_of(r);
    c.apart = candidate.apart;
    c.area = vertices[at(candidate.vertex)].area;
    looked_.push_back(c);
    predicted_.push_back(goal < candidate.apart ? 1 : 0);
    gaps_.push_back(distance - candidate.apart);
    weights_.push_back(1.0);
  }
}

void ContactRun::keep_multipliers() {
  met_.assign(contacts_.size(), 0);
  for (ContactNumbers& c : looked_) {
    const ContactNumbers* found = acting(c);
    if (found == nullptr) continue;
    const ContactNumbers& before = *found;
    met_[static_cast<std::size_t>(found - contacts_.data())] = 1;
    c.force = before.force;
    c.sliding = before.sliding;
    const Vec3 n = vector_of(c.normal);
    const Vec3 drag = vector_of(before.drag);
    c.drag = numbers_of(drag - n.dot(drag) * n);
  }
}

/// A vertex that slid to the next face hands its multiplier on, in equal shares.
void ContactRun::hand_over() {
  const auto& vertices = contact_.surfaces().vertices();
  const auto other_surface = [&](const ContactNumbers& c) {
    return vertices[static_cast<std::size_t>(c.vertex[1])].surface;
  };
  heirs_.clear();
  for (std::size_t i = 0; i < looked_.size(); ++i) {
    if (is_of_vertex(looked_[i])) heirs_.push_back(static_cast<std::int32_t>(i));
  }
  const auto vertex_of = [&](std::int32_t i) { return looked_[at(i)].a; };
  std::ranges::sort(heirs_, {}, [&](std::int32_t i) { return std::pair(vertex_of(i), i); });
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const ContactNumbers& before = contacts_[k];
    if (met_[k] != 0 || !is_of_vertex(before) || !(before.force > 0.0)) continue;
    if (hand_to(before.a, other_surface(before), 1.0, before) || !hands_to_all_) continue;
    const std::int32_t own = vertices[static_cast<std::size_t>(before.a)].surface;
    std::array<std::size_t, 3> others = {1, 2, 3};
    std::ranges::sort(others, {}, [&](std::size_t i) { return std::pair(-std::abs(before.beta[i]), i); });
    for (const std::size_t i : others) {
      if (before.vertex[i] >= 0.0 && before.beta[i] != 0.0 && hand_to(before.vertex[i], own, -1.0, before)) {
        break;
      }
    }
  }
}

/// To the contacts of a vertex with a surface; false: there are none. `heirs_` stands in the order of
/// vertices.
bool ContactRun::hand_to(double vertex, std::int32_t other, double sign, const ContactNumbers& before) {
  const auto& vertices = contact_.surfaces().vertices();
  const auto of_vertex =
      std::ranges::equal_range(heirs_, vertex, {}, [&](std::int32_t i) { return looked_[at(i)].a; });
  const auto is_heir = [&](std::int32_t i) {
    return vertices[static_cast<std::size_t>(looked_[at(i)].vertex[1])].surface == other;
  };
  const auto count = std::ranges::count_if(of_vertex, is_heir);
  const double share = 1.0 / static_cast<double>(count);
  for (const std::int32_t i : of_vertex) {
    if (!is_heir(i)) continue;
    ContactNumbers& c = looked_[at(i)];
    const bool soft = vertices[static_cast<std::size_t>(c.vertex[0])].is_soft() ||
                      vertices[static_cast<std::size_t>(c.vertex[1])].is_soft();
    if (!soft && c.force == 0.0) c.sliding = before.sliding;
    c.force += share * before.force;
    const Vec3 n = vector_of(c.normal);
    const Vec3 drag = sign * vector_of(before.drag);
    c.drag = numbers_of(vector_of(c.drag) + share * (drag - n.dot(drag) * n));
  }
  return count > 0;
}

}  // namespace tissu
