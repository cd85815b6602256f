#include "narrow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tissu/base/index.h"
#include "tissu/contact/closest.h"

namespace tissu {
namespace {

constexpr double kFan = 1e-6;       ///< tolerance of normal fans, of |r| times a length
constexpr double kParallel = 1e-3;  ///< of the square of the sine between two edges
constexpr double kNoWeight = 1e-9;

class Narrow {
 public:
  Narrow(const SurfaceSet& surfaces, ConstReals places, Found& found)
      : surfaces_(surfaces), places_(places), found_(found) {}

  bool vertex_face(const Candidate& candidate, double reach) {
    if (is_flat(candidate.vertex[0])) return false;
    Part part{};
    const Closest closest = closest_point_triangle(points(candidate), part);
    if (!take(candidate, closest, reach)) return false;
    const std::int32_t v = candidate.vertex[0];
    const std::int32_t face = candidate.b;
    if (part == Part::interior) {
      found_.area = surfaces_.vertices()[at(v)].has_faces ? shared_area(v, candidate.vertex[1])
                                                          : area_before_round(candidate, closest);
      return is_outside(face, closest.r, 1.0);
    }
    const auto& corners = surfaces_.primitives()[at(face)].vertex;
    if (part == Part::edge01 || part == Part::edge12 || part == Part::edge20) {
      const std::size_t i = part == Part::edge01 ? 0 : part == Part::edge12 ? 1 : 2;
      const std::int32_t e = surfaces_.triangle_edges(face)[i];
      if (surfaces_.edges()[at(e)].face[0] != face) return false;  // found by the first face beside it
      return vertex_edge(v, e, closest);
    }
    const std::int32_t w = corners[part == Part::vertex0 ? 0 : part == Part::vertex1 ? 1 : 2];
    if (!surfaces_.vertices()[at(v)].has_faces) return false;  // of a round thing: w finds it
    // Of two vertices of faces the lower one finds the other.
    const bool other_finds = v > w;
    return surfaces_.owner(w) == face && !other_finds && vertex_vertex(v, w, closest);
  }

  bool lone_edge(const Candidate& candidate, double reach) {
    Part part{};
    const Closest closest = closest_point_edge(points(candidate), part);
    if (!take(candidate, closest, reach)) return false;
    const std::int32_t v = candidate.vertex[0];
    if (part == Part::interior) return !is_flat(v) && vertex_edge(v, candidate.b, closest);
    const std::int32_t w = candidate.vertex[part == Part::vertex0 ? 1 : 2];
    if (surfaces_.vertices()[at(w)].has_faces) return false;
    if (surfaces_.vertices()[at(v)].has_faces) {
      return is_lowest_edge(w, candidate.b) && is_straight_before(v, -closest.r) && before_end(v, w, closest);
    }
    const bool other_finds = !surfaces_.vertices()[at(v)].is_lone && v > w;
    return is_lowest_edge(w, candidate.b) && !other_finds && vertex_vertex(v, w, closest);
  }

  bool edge_edge(const Candidate& candidate, double reach) {
    Part first{};
    Part second{};
    const Closest closest = closest_edge_edge(points(candidate), first, second);
    if (first != Part::interior || second != Part::interior) return false;
    if (!take(candidate, closest, reach)) return false;
    const SurfaceEdge& e = surfaces_.edges()[at(candidate.a)];
    const SurfaceEdge& f = surfaces_.edges()[at(candidate.b)];
    if (e.is_flat || f.is_flat) return false;
    if (!is_in_fan(candidate.a, -closest.r) || !is_in_fan(candidate.b, closest.r)) return false;
    found_.weight = weight_of_edges(surfaces_, places_, candidate.a, candidate.b);
    found_.area = 0.25 * (edge_area(e) + edge_area(f));
    return found_.weight > 0.0;
  }

  bool points_alone(const Candidate& candidate, double reach) {
    const Vec3 r = place(candidate.vertex[0]) - place(candidate.vertex[1]);
    if (!take(candidate, {{1.0, -1.0, 0.0, 0.0}, r, r.squaredNorm()}, reach)) return false;
    if (!is_straight_before(candidate.vertex[0], -r)) return false;
    found_.area = shared_area(candidate.vertex[0], candidate.vertex[1]);
    return true;
  }

 private:
  [[nodiscard]] Vec3 place(std::int32_t v) const { return block(places_, v); }
  /// The vertices of what comes near meet the plane itself.
  [[nodiscard]] bool is_flat(std::int32_t v) const { return surfaces_.vertices()[at(v)].is_flat; }
  [[nodiscard]] std::array<Vec3, 4> points(const Candidate& candidate) const {
    std::array<Vec3, 4> p{};
    for (int i = 0; i < vertices_of(candidate.kind); ++i) p[at(i)] = place(candidate.vertex[at(i)]);
    return p;
  }

  bool take(const Candidate& candidate, const Closest& closest, double reach) {
    if (!(closest.square < reach * reach) || !(closest.square > 0.0)) return false;
    found_ = {candidate.kind,
              candidate.a,
              candidate.b,
              candidate.vertex,
              closest.beta,
              closest.r,
              std::sqrt(closest.square),
              1.0,
              0.0};
    return true;
  }

  bool vertex_edge(std::int32_t v, std::int32_t e, const Closest& closest) {
    if (!is_in_fan(e, closest.r)) return false;
    const SurfaceEdge& edge = surfaces_.edges()[at(e)];
    const auto beta_of = [&](std::int32_t w) {
      double sum = 0.0;
      for (std::size_t k = 1; k < 4; ++k) {
        if (found_.vertex[k] == w) sum += closest.beta[k];
      }
      return sum;
    };
    found_.beta = {1.0, beta_of(edge.vertex[0]), beta_of(edge.vertex[1]), 0.0};
    found_.vertex = {v, edge.vertex[0], edge.vertex[1], -1};
    found_.kind = PairKind::vertex_edge;
    found_.b = e;
    found_.area = shared_area(v, edge.vertex[0]);
    return true;
  }

  /// r goes away from a vertex, into one of the edges there.
  [[nodiscard]] bool is_before_edges(std::int32_t of, const Vec3& r) const {
    const auto all = surfaces_.neighbours(of);
    return std::ranges::any_of(all, [&](std::int32_t u) {
      const Vec3 along = place(u) - place(of);
      return r.dot(along) > kFan * r.norm() * along.norm();
    });
  }

  /// What is round and not straight before a vertex inside a plane is before a face of it.
  [[nodiscard]] bool is_straight_before(std::int32_t v, const Vec3& r) const {
    return !is_flat(v) || !is_before_edges(v, r);
  }

  /// Before the round end w, whatever side v is seen from: inside its radius is inside. A dent that follows
  /// it has no other contacts than those of its vertices and of its faces' middles.
  bool before_end(std::int32_t v, std::int32_t w, const Closest& closest) {
    if (is_before_edges(w, closest.r)) return false;
    join_vertices(v, w);
    return true;
  }

  bool vertex_vertex(std::int32_t v, std::int32_t w, const Closest& closest) {
    if (is_before_edges(w, closest.r) || is_before_edges(v, -closest.r)) return false;
    if (!is_outside_vertex(w, closest.r) || !is_outside_vertex(v, -closest.r)) return false;
    join_vertices(v, w);
    return true;
  }

  void join_vertices(std::int32_t v, std::int32_t w) {
    found_.kind = PairKind::vertex_vertex;
    found_.b = w;
    found_.vertex = {v, w, -1, -1};
    found_.beta = {1.0, -1.0, 0.0, 0.0};
    found_.area = shared_area(v, w);
  }

  [[nodiscard]] Vec3 normal(std::int32_t face) const {
    const auto& [a, b, c] = surfaces_.primitives()[at(face)].vertex;
    return (place(b) - place(a)).cross(place(c) - place(a));
  }
  [[nodiscard]] bool is_closed(std::int32_t vertex) const {
    return surfaces_.surfaces()[at(surfaces_.vertices()[at(vertex)].surface)].closed;
  }
  [[nodiscard]] bool is_outside(std::int32_t face, const Vec3& r, double sign) const {
    return !is_closed(surfaces_.primitives()[at(face)].vertex[0]) || sign * normal(face).dot(r) > 0.0;
  }
  /// Before the corner, not behind it: the normals of a vertex's faces are approximated by those of its
  /// edges.
  [[nodiscard]] bool is_outside_vertex(std::int32_t v, const Vec3& r) const {
    if (!surfaces_.vertices()[at(v)].has_faces || !is_closed(v)) return true;
    return is_outside(surfaces_.owner(v), r, 1.0);
  }
  /// r starts on the edge and goes away from it: into none of the faces beside it, and outwards.
  [[nodiscard]] bool is_in_fan(std::int32_t e, const Vec3& r) const {
    const SurfaceEdge& edge = surfaces_.edges()[at(e)];
    const Vec3 from = place(edge.vertex[0]);
    const Vec3 along = (place(edge.vertex[1]) - from).normalized();
    Vec3 outwards = Vec3::Zero();
    for (std::size_t side = 0; side < 2 && edge.face[side] >= 0; ++side) {
      Vec3 into = place(edge.across[side]) - from;
      into -= along.dot(into) * along;
      if (r.dot(into) > kFan * r.norm() * into.norm()) return false;
      outwards += normal(edge.face[side]).normalized();
    }
    return edge.is_lone() || !is_closed(edge.vertex[0]) || outwards.dot(r) > 0.0;
  }
  /// Of the lone edges at a vertex, the one that finds it.
  [[nodiscard]] bool is_lowest_edge(std::int32_t w, std::int32_t e) const {
    return surfaces_.triangle_edges(surfaces_.owner(w))[0] == e;
  }
  [[nodiscard]] double shared_area(std::int32_t v, std::int32_t other) const {
    const double area = surfaces_.vertices()[at(v)].area;
    return surfaces_.vertices()[at(other)].is_free() ? 0.5 * area : area;
  }
  /// What is round has no area: that of the face's corners, by their weights.
  [[nodiscard]] double area_before_round(const Candidate& candidate, const Closest& closest) const {
    double sum = 0.0;
    for (std::size_t k = 1; k < 4; ++k) {
      sum -= closest.beta[k] * surfaces_.vertices()[at(candidate.vertex[k])].area;
    }
    return sum;
  }
  [[nodiscard]] double edge_area(const SurfaceEdge& e) const {
    double sum = 0.0;
    for (std::size_t side = 0; side < 2 && e.face[side] >= 0; ++side)
      sum += normal(e.face[side]).norm() / 6.0;
    return sum;
  }

  const SurfaceSet& surfaces_;
  ConstReals places_;
  Found& found_;
};

}  // namespace

double weight_of_edges(const SurfaceSet& surfaces, ConstReals places, std::int32_t e, std::int32_t f) {
  const SurfaceEdge& first = surfaces.edges()[at(e)];
  const SurfaceEdge& second = surfaces.edges()[at(f)];
  const Vec3 along = block(places, first.vertex[1]) - block(places, first.vertex[0]);
  const Vec3 other = block(places, second.vertex[1]) - block(places, second.vertex[0]);
  const double sine = along.cross(other).squaredNorm();
  const double least = kParallel * first.length * first.length * second.length * second.length;
  if (sine >= least) return 1.0;
  const double weight = (2.0 - sine / least) * sine / least;
  return weight > kNoWeight ? weight : 0.0;
}

bool find_contact(const SurfaceSet& surfaces, ConstReals places, const Candidate& candidate, double reach,
                  Found& found) {
  Narrow narrow(surfaces, places, found);
  switch (candidate.kind) {
    case PairKind::vertex_face:
      return narrow.vertex_face(candidate, reach);
    case PairKind::edge_edge:
      return narrow.edge_edge(candidate, reach);
    case PairKind::vertex_edge:
      return narrow.lone_edge(candidate, reach);
    case PairKind::vertex_vertex:
      break;
  }
  return narrow.points_alone(candidate, reach);
}

}  // namespace tissu
