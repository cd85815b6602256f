/// The features of two primitives that may meet, and the distance that they keep.

#include <algorithm>
#include <cmath>

#include "nearest_pair.h"
#include "tissu/base/index.h"
#include "tissu/contact/candidates.h"

namespace tissu {
namespace {

/// Share of the radii of what has no faces to which its middle may come near on a way: a ball that grazes
/// something is found inside it at the end of no step.
constexpr double kRound = 0.85;

constexpr double kOfRest = 0.9;    ///< of the distance at rest: where such pairs are held apart, …
constexpr double kOfJoined = 0.1;  ///< … if material that is not parted holds them apart by itself

}  // namespace

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
  if (own != other) {
    const std::span<const std::int32_t> both(vertex);
    if (surfaces_.is_of_one_row(both.first(at(first)), both.subspan(at(first), at(all - first)))) return;
  }
  double apart = radius + other_radius + pair.gap;
  if (own == other) apart = apart_at_rest(kind, vertex, apart);
  if (!(apart > 0.0)) return;
  const bool round = !vertices[at(vertex[0])].has_faces || !vertices[at(vertex[at(first)])].has_faces;
  const double thick = std::min((radius + other_radius) / apart, 1.0);
  list_.push_back(
      {kind, a, b, number, vertex, apart, std::max(Candidate::kKept, round ? kRound * thick : 0.0)});
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

}  // namespace tissu
