#include "tissu/contact/candidates.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "nearest_pair.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kSkin = 0.1;         ///< of the mean edge
constexpr double kSure = 1.0 - 1e-9;  ///< of a distance: round-off is less
constexpr double kGapSkin = 0.5;      ///< of the gap

}  // namespace

Candidates::Candidates(const ContactDescription& description, const SurfaceSet& surfaces, Ways ways)
    : description_(description), surfaces_(surfaces), ways_(ways) {
  const std::size_t count = surfaces.surfaces().size();
  const auto is_plane = [&](std::int32_t s) {
    return surfaces.first_primitive()[at(s)] == surfaces.first_primitive()[at(s) + 1];
  };
  pair_.assign(count * count, -1);
  reach_.assign(count, 0.0);
  on_.resize(description.pairs.size());
  is_own_.assign(description.pairs.size(), 0);
  fixed_.meets.assign(count, 0);
  own_.meets.assign(count, 0);
  SearchPlan between{surfaces.first_primitive(), {}};
  SearchPlan within = between;
  for (std::size_t k = 0; k < description.pairs.size(); ++k) {
    const ContactPair& pair = description.pairs[k];
    for (const std::int32_t s : {pair.a, pair.b}) reach_[at(s)] = std::max(reach_[at(s)], pair.gap);
    if (!pair.nodes.empty()) {
      on_[k].assign(surfaces.vertices().size(), 1);
      const auto& of = surfaces.surfaces()[at(pair.a)];
      std::fill(on_[k].begin() + of.first_vertex, on_[k].begin() + of.last_vertex, std::uint8_t{0});
      for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
        if (surfaces.is_among(pair.nodes, v)) on_[k][at(v)] = 1;
      }
    }
    const auto [low, high] = std::minmax(pair.a, pair.b);
    std::int32_t& place = pair_[at(low) * count + at(high)];
    if (place < 0) place = static_cast<std::int32_t>(k);
    if (is_plane(low) || is_plane(high)) continue;
    is_own_[k] = ways == Ways::together && low == high ? 1 : 0;
    Seen& seen = is_own_[k] != 0 ? own_ : fixed_;
    seen.meets[at(low)] = seen.meets[at(high)] = 1;
    (is_own_[k] != 0 ? within : between).meetings.push_back({low, high});
  }
  for (std::size_t s = 0; s < count; ++s) {
    skin_.push_back(kGapSkin * reach_[s] + kSkin * surfaces.mean_edge(static_cast<std::int32_t>(s)));
  }
  const bool only_planes = between.meetings.empty() && within.meetings.empty();
  if (only_planes || !between.meetings.empty()) {
    fixed_.broad = make_broad_phase(description.broad_phase, between);
  }
  if (!within.meetings.empty()) {
    own_.broad = make_broad_phase(description.broad_phase, within);
    mean_from_.resize(3 * count);
    mean_to_.resize(3 * count);
  }
  list_planes();
}

std::int32_t Candidates::pair_of(std::int32_t a, std::int32_t b) const {
  const auto [low, high] = std::minmax(a, b);
  return pair_[at(low) * surfaces_.surfaces().size() + at(high)];
}

void Candidates::list_planes() {
  const std::size_t bodies = description_.bodies.size();
  for (std::size_t k = 0; k < description_.pairs.size(); ++k) {
    const ContactPair& pair = description_.pairs[k];
    for (const auto& [plane, body] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      if (at(plane) < bodies || !description_.obstacles[at(plane) - bodies].plane) continue;
      const auto& of = surfaces_.surfaces()[at(body)];
      for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
        if (!on_[k].empty() && on_[k][at(v)] == 0) continue;
        planes_.push_back({v, plane - static_cast<std::int32_t>(bodies), static_cast<std::int32_t>(k),
                           surfaces_.vertices()[at(v)].radius + pair.gap});
      }
    }
  }
}

/// f(surface, vertex) for the vertices of the surfaces that have pairs seen so.
template <class Function>
void Candidates::for_seen(const Seen& seen, Function&& f) const {
  for (std::size_t s = 0; s < seen.meets.size(); ++s) {
    if (seen.meets[s] == 0) continue;
    const SurfaceSet::Surface& surface = surfaces_.surfaces()[s];
    for (std::int32_t v = surface.first_vertex; v < surface.last_vertex; ++v) {
      f(static_cast<std::int32_t>(s), v);
    }
  }
}

void Candidates::find_means(ConstReals from, ConstReals to) {
  for (std::size_t s = 0; s < own_.meets.size(); ++s) {
    if (own_.meets[s] == 0) continue;
    const SurfaceSet::Surface& surface = surfaces_.surfaces()[s];
    Vec3 begin = Vec3::Zero();
    Vec3 end = Vec3::Zero();
    for (std::int32_t v = surface.first_vertex; v < surface.last_vertex; ++v) {
      begin += block(from, v);
      end += block(to, v);
    }
    const double count = surface.last_vertex - surface.first_vertex;
    const auto number = static_cast<std::int32_t>(s);
    block(Reals(mean_from_), number) = begin / count;
    block(Reals(mean_to_), number) = end / count;
  }
}

void Candidates::lay_ways(Seen& seen, ConstReals from, ConstReals to, ConstReals sways) const {
  if (!seen.broad) return;
  seen.ways.resize(surfaces_.vertices().size());
  const bool from_mean = &seen == &own_;
  for_seen(seen, [&](std::int32_t s, std::int32_t v) {
    Vec3 begin = block(from, v);
    Vec3 end = block(to, v);
    if (from_mean) {
      begin -= block(ConstReals(mean_from_), s);
      end -= block(ConstReals(mean_to_), s);
    }
    Box& box = seen.ways[at(v)];
    box = Box::none();
    box.add(begin);
    box.add(end);
    if (!sways.empty()) box.grow(sways[at(v)]);
  });
}

/// A straight way stays in a box that holds both its ends.
bool Candidates::is_covered(const Seen& seen, ConstReals from, ConstReals to) const {
  if (!seen.broad) return true;
  const bool from_mean = &seen == &own_;
  std::size_t left = 0;
  for_seen(seen, [&](std::int32_t s, std::int32_t v) {
    const Box& box = seen.searched[at(v)];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = 3 * at(v) + k;
      const double begin = from_mean ? from[i] - mean_from_[3 * at(s) + k] : from[i];
      const double end = from_mean ? to[i] - mean_to_[3 * at(s) + k] : to[i];
      const auto low = static_cast<double>(box.low[k]);
      const auto high = static_cast<double>(box.high[k]);
      left += static_cast<std::size_t>(begin < low) | static_cast<std::size_t>(end < low) |
              static_cast<std::size_t>(begin > high) | static_cast<std::size_t>(end > high);
    }
  });
  return left == 0;
}

/// The same of ways that may sway.
bool Candidates::is_covered(const Seen& seen) const {
  bool covered = true;
  for_seen(seen, [&](std::int32_t /*surface*/, std::int32_t v) {
    const Box& inner = seen.ways[at(v)];
    const Box& outer = seen.searched[at(v)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) covered = false;
    }
  });
  return covered;
}

bool Candidates::cover(ConstReals from, ConstReals to, ConstReals sways) {
  if (own_.broad) find_means(from, to);
  const auto lay = [&] {
    lay_ways(fixed_, from, to, sways);
    lay_ways(own_, from, to, sways);
  };
  if (!sways.empty()) lay();
  const auto stays = [&](const Seen& seen) {
    return sways.empty() ? is_covered(seen, from, to) : is_covered(seen);
  };
  const bool covered = is_listed_ && stays(fixed_) && stays(own_);
  if (!covered) {
    if (sways.empty()) lay();
    search();
    measure(from);
  }
  follow(fixed_, from, to, sways);
  follow(own_, from, to, sways);
  return !covered;
}

void Candidates::search(Seen& seen) {
  seen.found.clear();
  if (!seen.broad) return;
  // Refused ways leave the list with its margins.
  boxes_.assign(surfaces_.primitives().size(), Box{});
  for (std::size_t p = 0; p < boxes_.size(); ++p) {
    const auto surface = surfaces_.surface_of_primitive(static_cast<std::int32_t>(p));
    if (seen.meets[at(surface)] == 0) continue;
    Box box = Box::none();
    double radius = 0.0;
    const Primitive& primitive = surfaces_.primitives()[p];
    for (int i = 0; i < primitive.corners; ++i) {
      const std::int32_t v = primitive.vertex[at(i)];
      box.add(seen.ways[at(v)]);
      radius = std::max(radius, surfaces_.vertices()[at(v)].radius);
    }
    box.grow(radius + reach_[at(surface)] + skin_[at(surface)]);
    boxes_[p] = box;
  }
  seen.broad->find(boxes_, seen.found);
}

/// The features of two primitives do not depend on where these are: those of pairs that were found before are
/// taken over.
void Candidates::search() {
  search(fixed_);
  search(own_);
  for (Seen* seen : {&fixed_, &own_}) {
    seen->searched = seen->ways;
    for_seen(*seen, [&](std::int32_t s, std::int32_t v) { seen->searched[at(v)].grow(skin_[at(s)]); });
  }
  is_listed_ = true;
  std::swap(found_, found_before_);
  found_.clear();
  std::ranges::merge(fixed_.found, own_.found, std::back_inserter(found_));
  std::swap(list_, list_before_);
  std::swap(begin_, begin_before_);
  list_.clear();
  begin_.clear();
  std::size_t k = 0;
  for (const BoxPair& pair : found_) {
    begin_.push_back(list_.size());
    while (k < found_before_.size() && found_before_[k] < pair) ++k;
    if (k == found_before_.size() || found_before_[k] != pair) {
      list_features(pair);
      continue;
    }
    const auto at_pair = list_before_.begin();
    list_.insert(list_.end(), at_pair + static_cast<std::ptrdiff_t>(begin_before_[k]),
                 at_pair + static_cast<std::ptrdiff_t>(begin_before_[k + 1]));
  }
  begin_.push_back(list_.size());
}

/// The distances of all, and which of them may come near while the list is kept.
void Candidates::measure(ConstReals places) {
  made_.assign(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(surfaces_.rest().size()));
  mean_made_ = mean_from_;
  for (Seen* seen : {&fixed_, &own_}) {
    if (!seen->broad) continue;
    seen->room.resize(surfaces_.vertices().size());
    for_seen(*seen, [&](std::int32_t s, std::int32_t v) {
      Vec3 place = block(places, v);
      if (seen == &own_) place -= block(ConstReals(mean_from_), s);
      double square = 0.0;
      const Box& box = seen->searched[at(v)];
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = place[static_cast<Eigen::Index>(k)];
        const double most =
            std::max(x - static_cast<double>(box.low[k]), static_cast<double>(box.high[k]) - x);
        square += most * most;
      }
      seen->room[at(v)] = std::sqrt(square) / kSure;
    });
  }
  distance_.assign(list_.size(), -1.0);
  near_.clear();
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const Candidate& c = list_[i];
    const double reach = c.apart + description_.pairs[at(c.pair)].gap;
    if (!is_farther(i, gone(c, seen_of(c).room) + reach)) near_.push_back(static_cast<std::int32_t>(i));
  }
}

bool Candidates::is_farther(std::size_t i, double than) const {
  if (distance_[i] < 0.0) {
    const Candidate& c = list_[i];
    const auto place = [&](int k) { return Vec3(block(ConstReals(made_), c.vertex[at(k)])); };
    if ((place(0) - place(vertices_of_first(c.kind))).squaredNorm() <= than * than) return false;
    std::array<Vec3, 4> p{};
    for (int k = 0; k < vertices_of(c.kind); ++k) p[at(k)] = place(k);
    distance_[i] = kSure * std::sqrt(nearest_of(c.kind, p).square);
  }
  return distance_[i] > than;
}

void Candidates::follow(Seen& seen, ConstReals from, ConstReals to, ConstReals sways) const {
  if (!seen.broad) return;
  seen.gone.resize(surfaces_.vertices().size());
  // What rows carry may leave its way, be all shares the same or not.
  seen.shifts.resize(ways_ == Ways::together && sways.empty() ? 6 * seen.gone.size() : 0);
  const bool from_mean = &seen == &own_;
  for_seen(seen, [&](std::int32_t s, std::int32_t v) {
    const Vec3 was = block(ConstReals(made_), v);
    Vec3 begin = block(from, v) - was;
    Vec3 end = block(to, v) - was;
    if (from_mean) {
      const Vec3 mean = block(ConstReals(mean_made_), s);
      begin -= block(ConstReals(mean_from_), s) - mean;
      end -= block(ConstReals(mean_to_), s) - mean;
    }
    double& gone = seen.gone[at(v)];
    gone = std::sqrt(std::max(begin.squaredNorm(), end.squaredNorm()));
    if (!sways.empty()) gone += sways[at(v)];
    if (seen.shifts.empty()) return;
    block(Reals(seen.shifts), 2 * v) = begin;
    block(Reals(seen.shifts), 2 * v + 1) = end;
  });
}

double Candidates::gone_together(const Candidate& c, ConstReals shifts) {
  const int first = vertices_of_first(c.kind);
  double largest = 0.0;
  for (int i = 0; i < first; ++i) {
    const std::int32_t v = c.vertex[at(i)];
    for (int j = first; j < vertices_of(c.kind); ++j) {
      const std::int32_t w = c.vertex[at(j)];
      const double at_begin = (block(shifts, 2 * v) - block(shifts, 2 * w)).squaredNorm();
      const double at_end = (block(shifts, 2 * v + 1) - block(shifts, 2 * w + 1)).squaredNorm();
      largest = std::max({largest, at_begin, at_end});
    }
  }
  return std::sqrt(largest);
}

std::size_t Candidates::bytes() const {
  std::size_t sum = (list_.capacity() + list_before_.capacity()) * sizeof(Candidate) +
                    (found_.capacity() + found_before_.capacity()) * sizeof(BoxPair) +
                    (begin_.capacity() + begin_before_.capacity()) * sizeof(std::size_t) +
                    boxes_.size() * sizeof(Box) + planes_.size() * sizeof(PlaneCandidate) +
                    near_.capacity() * sizeof(std::int32_t);
  for (const Seen* seen : {&fixed_, &own_}) {
    if (seen->broad) sum += seen->broad->bytes();
    sum += (seen->ways.size() + seen->searched.size()) * sizeof(Box) +
           (seen->room.size() + seen->gone.size()) * sizeof(double) +
           seen->found.capacity() * sizeof(BoxPair);
  }
  return sum;
}

}  // namespace tissu
