#include "tissu/contact/candidates.h"

#include <algorithm>
#include <cmath>

#include "nearest_pair.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kOfRest = 0.9;       ///< of the distance at rest: where such pairs are held apart, …
constexpr double kOfJoined = 0.1;     ///< … if material that is not parted holds them apart by itself
constexpr double kSkin = 0.1;         ///< of the mean edge
constexpr double kSure = 1.0 - 1e-9;  ///< of a distance: round-off is less
constexpr double kGapSkin = 0.5;      ///< of the gap

}  // namespace

Candidates::Candidates(const ContactDescription& description, const SurfaceSet& surfaces)
    : description_(description), surfaces_(surfaces) {
  const std::size_t count = surfaces.surfaces().size();
  pair_.assign(count * count, -1);
  reach_.assign(count, 0.0);
  on_.resize(description.pairs.size());
  SearchPlan plan;
  plan.first = surfaces.first_primitive();
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
    plan.meetings.push_back({low, high});
  }
  for (std::size_t s = 0; s < count; ++s) {
    skin_.push_back(kGapSkin * reach_[s] + kSkin * surfaces.mean_edge(static_cast<std::int32_t>(s)));
  }
  broad_ = make_broad_phase(description.broad_phase, plan);
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

void Candidates::box(ConstReals from, ConstReals to, ConstReals sways) {
  const auto& primitives = surfaces_.primitives();
  needed_.resize(primitives.size());
  ways_.resize(surfaces_.vertices().size());
  for (std::size_t v = 0; v < ways_.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    ways_[v] = Box::none();
    ways_[v].add(Vec3(block(from, number)));
    ways_[v].add(Vec3(block(to, number)));
  }
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    Box box = Box::none();
    double radius = 0.0;
    for (int i = 0; i < primitives[p].corners; ++i) {
      const std::int32_t v = primitives[p].vertex[at(i)];
      box.add(ways_[at(v)]);
      radius = std::max(radius, surfaces_.vertices()[at(v)].radius + (sways.empty() ? 0.0 : sways[at(v)]));
    }
    box.grow(radius + reach_[at(surfaces_.surface_of_primitive(static_cast<std::int32_t>(p)))]);
    needed_[p] = box;
  }
}

bool Candidates::cover(ConstReals from, ConstReals to, ConstReals sways) {
  box(from, to, sways);
  const auto is_inside = [](const Box& inner, const Box& outer) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
    }
    return true;
  };
  bool covered = searched_.size() == needed_.size();
  for (std::size_t p = 0; covered && p < needed_.size(); ++p) covered = is_inside(needed_[p], searched_[p]);
  if (covered) {
    follow(from, to, sways);
    return false;
  }
  search();
  measure(from);
  follow(from, to, sways);
  return true;
}

/// The features of two primitives do not depend on where these are: those of pairs that were found before are
/// taken over.
void Candidates::search() {
  for (std::size_t p = 0; p < needed_.size(); ++p) {
    needed_[p].grow(skin_[at(surfaces_.surface_of_primitive(static_cast<std::int32_t>(p)))]);
  }
  broad_->find(needed_, found_before_);  // refuses what is not finite: then the list stays with its boxes
  std::swap(searched_, needed_);
  std::swap(found_, found_before_);
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

void Candidates::measure(ConstReals places) {
  made_.assign(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(surfaces_.rest().size()));
  distance_.resize(list_.size());
  for (std::size_t i = 0; i < list_.size(); ++i) {
    std::array<Vec3, 4> p{};
    for (int k = 0; k < vertices_of(list_[i].kind); ++k) p[at(k)] = block(places, list_[i].vertex[at(k)]);
    distance_[i] = kSure * std::sqrt(nearest_of(list_[i].kind, p).square);
  }
}

void Candidates::follow(ConstReals from, ConstReals to, ConstReals sways) {
  gone_.resize(made_.size() / 3);
  for (std::size_t v = 0; v < gone_.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    const Vec3 was = block(ConstReals(made_), number);
    gone_[v] = std::sqrt(
        std::max((block(from, number) - was).squaredNorm(), (block(to, number) - was).squaredNorm()));
    if (!sways.empty()) gone_[v] += sways[v];
  }
}

void Candidates::list_features(const BoxPair& pair) {
  const auto& primitives = surfaces_.primitives();
  const auto& vertices = surfaces_.vertices();
  const auto& edges = surfaces_.edges();
  for (const auto& [p, q] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
    const Primitive& other = primitives[at(q)];
    for (const std::int32_t v : surfaces_.vertices_of(p)) {
      if (other.corners == 3) {
        add(PairKind::vertex_face, v, q, {v, other.vertex[0], other.vertex[1], other.vertex[2]});
      }
      for (const std::int32_t e : surfaces_.edges_of(q)) {
        if (edges[at(e)].is_lone()) {
          add(PairKind::vertex_edge, v, e, {v, edges[at(e)].vertex[0], edges[at(e)].vertex[1], -1});
        }
      }
    }
  }
  for (const std::int32_t e : surfaces_.edges_of(pair.a)) {
    for (const std::int32_t f : surfaces_.edges_of(pair.b)) {
      const auto& [a, b] = edges[at(e)].vertex;
      const auto& [c, d] = edges[at(f)].vertex;
      add(PairKind::edge_edge, e, f, {a, b, c, d});
    }
  }
  for (const std::int32_t v : surfaces_.vertices_of(pair.a)) {
    for (const std::int32_t w : surfaces_.vertices_of(pair.b)) {
      // What is round is the second; of two such things the order is theirs.
      const bool may_be_round = vertices[at(w)].is_lone;
      if (may_be_round && (vertices[at(v)].is_lone || vertices[at(v)].has_faces)) {
        add(PairKind::vertex_vertex, v, w, {v, w, -1, -1});
      } else if (vertices[at(v)].is_lone && vertices[at(w)].has_faces) {
        add(PairKind::vertex_vertex, w, v, {w, v, -1, -1});
      }
    }
  }
}

bool Candidates::may_meet(const ContactPair& pair, const std::array<std::int32_t, 4>& vertex) const {
  const auto& on = on_[static_cast<std::size_t>(&pair - description_.pairs.data())];
  if (on.empty()) return true;
  return std::ranges::all_of(vertex, [&](std::int32_t v) { return v < 0 || on[at(v)] != 0; });
}

void Candidates::add(PairKind kind, std::int32_t a, std::int32_t b, std::array<std::int32_t, 4> vertex) {
  const auto& vertices = surfaces_.vertices();
  const int first = vertices_of_first(kind);
  const int all = vertices_of(kind);
  bool free = false;
  double radius = 0.0;
  double other_radius = 0.0;
  for (int i = 0; i < all; ++i) {
    const SurfaceVertex& v = vertices[at(vertex[at(i)])];
    free = free || v.is_free();
    double& of = i < first ? radius : other_radius;
    of = std::max(of, v.radius);
    for (int j = first; i < first && j < all; ++j) {
      const SurfaceVertex& w = vertices[at(vertex[at(j)])];
      if (vertex[at(i)] == vertex[at(j)] || (v.row >= 0 && v.row == w.row)) return;
    }
  }
  const std::int32_t own = vertices[at(vertex[0])].surface;
  const std::int32_t other = vertices[at(vertex[at(first)])].surface;
  const std::int32_t number = pair_of(own, other);
  if (!free || number < 0) return;
  const ContactPair& pair = description_.pairs[at(number)];
  if (!may_meet(pair, vertex)) return;
  double apart = radius + other_radius + pair.gap;
  if (own == other) apart = apart_at_rest(kind, vertex, apart);
  if (apart > 0.0) list_.push_back({kind, a, b, number, vertex, apart});
}

double Candidates::apart_at_rest(PairKind kind, const std::array<std::int32_t, 4>& vertex,
                                 double apart) const {
  std::array<Vec3, 4> p{};
  for (int i = 0; i < vertices_of(kind); ++i) {
    p[at(i)] = block(ConstReals(surfaces_.rest()), vertex[at(i)]);
  }
  double share = kOfRest;
  if (surfaces_.has_riders()) {
    const std::span<const std::int32_t> all(vertex);
    const auto first = at(vertices_of_first(kind));
    const auto rest = all.subspan(first, at(vertices_of(kind)) - first);
    const auto rides = [&](std::int32_t v) { return v >= 0 && surfaces_.vertices()[at(v)].rider >= 0; };
    if (std::ranges::any_of(all, rides)) {
      share = surfaces_.is_joined(all.first(first), rest) ? kOfJoined : kOfWalls;
    }
  }
  return std::min(apart, share * std::sqrt(nearest_of(kind, p).square));
}

std::size_t Candidates::bytes() const {
  return broad_->bytes() + (list_.capacity() + list_before_.capacity()) * sizeof(Candidate) +
         (found_.capacity() + found_before_.capacity()) * sizeof(BoxPair) +
         (begin_.capacity() + begin_before_.capacity()) * sizeof(std::size_t) +
         (ways_.size() + needed_.size() + searched_.size()) * sizeof(Box) +
         planes_.size() * sizeof(PlaneCandidate);
}

}  // namespace tissu
