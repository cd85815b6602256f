#include "round.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tissu {
namespace {

constexpr double kChord = 8.0;     ///< square of a chord over its height and the radius
constexpr std::int32_t kMost = 8;  ///< parts: a thinner thing presses single faces
constexpr std::int32_t kInside = (kMost + 1) * (kMost + 1);  ///< numbers of points inside faces end here
constexpr std::int32_t kRim = kInside + 3 * kMost;           ///< and of those on their edges here

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::int32_t parts_of(double length, double radius, double gap) {
  return static_cast<std::int32_t>(
      std::ceil(std::min(length / std::sqrt(kChord * radius * gap), kMost + 1.0)));
}

}  // namespace

int parts_before_round(const SurfaceSet& surfaces, const Candidate& candidate) {
  const auto& vertices = surfaces.vertices();
  const auto& edges = surfaces.edges();
  const SurfaceVertex& first = vertices[at(candidate.vertex[0])];
  double length = 0.0;
  double radius = first.radius;
  double other = 0.0;
  if (candidate.kind == PairKind::vertex_face) {
    if (first.has_faces || !vertices[at(candidate.vertex[1])].is_soft()) return 0;
    other = vertices[at(candidate.vertex[1])].radius;
    for (const std::int32_t e : surfaces.triangle_edges(candidate.b)) {
      length = std::max(length, edges[at(e)].length);
    }
  } else if (candidate.kind != PairKind::edge_edge) {
    return 0;
  } else {
    const SurfaceVertex& second = vertices[at(candidate.vertex[2])];
    const bool is_first = edges[at(candidate.a)].is_lone();
    if (is_first == edges[at(candidate.b)].is_lone()) return 0;
    if (!(is_first ? second : first).is_soft()) return 0;
    length = edges[at(is_first ? candidate.b : candidate.a)].length;
    other = second.radius;
    if (!is_first) std::swap(radius, other);
  }
  const double gap = candidate.apart - radius - other;
  if (!(radius > 0.0) || !(gap > 0.0)) return 0;
  const std::int32_t parts = parts_of(length, radius, gap);
  return parts > kMost ? 0 : std::max(parts, 1);
}

RoundPoints::RoundPoints(const SurfaceSet& surfaces, ConstReals places, const Candidate& candidate, int parts)
    : surfaces_(surfaces), places_(places), candidate_(candidate), parts_(parts) {}

bool RoundPoints::next(double reach, Found& found) {
  if (parts_ == 1) return false;
  const bool face = candidate_.kind == PairKind::vertex_face;
  const std::int32_t last = face ? kRim : parts_;
  while (++number_ < last) {
    const bool is_there = !face               ? edge_point(number_, found)
                          : number_ < kInside ? face_point(number_, found)
                                              : rim_point(number_ - kInside, found);
    if (is_there && found.distance < reach) return true;
  }
  return false;
}

bool RoundPoints::meet(const std::array<std::int32_t, 4>& vertex, const std::array<double, 4>& beta,
                       double area, Found& found) const {
  Vec3 r = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (vertex[k] >= 0) r += beta[k] * place(vertex[k]);
  }
  found = {candidate_.kind, candidate_.a, candidate_.b, vertex, beta, r, r.norm(), 1.0, area};
  return found.distance > 0.0;
}

bool RoundPoints::face_point(std::int32_t number, Found& found) const {
  const std::int32_t i = number / (kMost + 1);
  const std::int32_t j = number % (kMost + 1);
  const std::int32_t k = parts_ - i - j;
  if (i < 1 || j < 1 || k < 1) return false;
  const auto& [v, a, b, c] = candidate_.vertex;
  const Vec3 normal = (place(b) - place(a)).cross(place(c) - place(a));
  const bool closed = surfaces_.surfaces()[at(surfaces_.vertices()[at(a)].surface)].closed;
  const double part = 1.0 / parts_;
  if (!meet(candidate_.vertex, {1.0, -part * i, -part * j, -part * k}, part * part * normal.norm(), found)) {
    return false;
  }
  return !closed || normal.dot(found.r) > 0.0;
}

bool RoundPoints::rim_point(std::int32_t number, Found& found) const {
  const std::int32_t e = surfaces_.triangle_edges(candidate_.b)[at(number / kMost)];
  const SurfaceEdge& edge = surfaces_.edges()[at(e)];
  const std::int32_t i = number % kMost;
  if (i < 1 || edge.face[0] != candidate_.b) return false;
  const SurfaceVertex& round = surfaces_.vertices()[at(candidate_.vertex[0])];
  const double other = surfaces_.vertices()[at(edge.vertex[0])].radius;
  const std::int32_t parts = parts_of(edge.length, round.radius, candidate_.apart - round.radius - other);
  if (i >= parts) return false;
  const double share = static_cast<double>(i) / parts;
  const double area = surfaces_.vertices()[at(edge.vertex[0])].area / parts;
  return meet({candidate_.vertex[0], edge.vertex[0], edge.vertex[1], -1}, {1.0, share - 1.0, -share, 0.0},
              area, found);
}

/// A point of the edge that has faces, before the inside of the lone one.
bool RoundPoints::edge_point(std::int32_t number, Found& found) const {
  const bool is_first = surfaces_.edges()[at(candidate_.a)].is_lone();
  const auto& [a, b, c, d] = candidate_.vertex;
  const Vec3 from = place(is_first ? a : c);
  const Vec3 along = place(is_first ? b : d) - from;
  const double share = static_cast<double>(number) / parts_;
  const Vec3 point = (1.0 - share) * place(is_first ? c : a) + share * place(is_first ? d : b);
  const double t = (point - from).dot(along) / along.squaredNorm();
  if (!(t > 0.0 && t < 1.0)) return false;
  const double first = is_first ? t : share;
  const double second = is_first ? share : t;
  const double area = surfaces_.vertices()[at(is_first ? c : a)].area / parts_;
  return meet(candidate_.vertex, {1.0 - first, first, second - 1.0, -second}, area, found);
}

}  // namespace tissu
