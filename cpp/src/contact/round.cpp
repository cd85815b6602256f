#include "round.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kChord = 8.0;                      ///< square of a chord over its height and the radius
constexpr std::int32_t kMost = 8;                   ///< parts: a thinner thing presses single faces
constexpr std::int32_t kFinest = 8;                 ///< into how many a part is divided that is stretched
constexpr std::int32_t kAll = 32;                   ///< parts of a stretched edge
constexpr double kStretch = 1.05;                   ///< of a part, without its being divided
constexpr std::int32_t kRow = kMost * kFinest + 1;  ///< points of an edge that can be numbered
constexpr std::int32_t kInside = kRow * kRow;       ///< numbers of points inside faces end here

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

RoundPoints::RoundPoints(const SurfaceSet& surfaces, ConstReals places, ConstReals begin,
                         const Candidate& candidate, int parts)
    : surfaces_(surfaces), places_(places), begin_(begin), candidate_(candidate) {
  const auto& vertices = surfaces.vertices();
  const double radius = vertices[at(candidate.vertex[0])].radius;
  const double other = vertices[at(candidate.vertex[candidate.kind == PairKind::vertex_face ? 1 : 2])].radius;
  double length = 0.0;
  if (candidate.kind == PairKind::vertex_face) {
    rim_ = -1;
    for (const std::int32_t e : surfaces.triangle_edges(candidate.b)) {
      length = std::max(length, length_at_begin(e));
    }
    division_ = divided(parts, chord(radius, other), length);
  } else {
    const bool is_first = surfaces.edges()[at(candidate.a)].is_lone();
    length = length_at_begin(is_first ? candidate.b : candidate.a);
    division_ = divided(parts, is_first ? chord(radius, other) : chord(other, radius), length);
    i_ = 0;
  }
}

RoundPoints::Division RoundPoints::divided(std::int32_t parts, double chord, double length) const {
  std::int32_t finer = 1;
  while (length > kStretch * chord * finer * parts && finer < kFinest && 2 * finer * parts <= kAll)
    finer *= 2;
  return {parts, finer};
}

double RoundPoints::length_at_begin(std::int32_t edge) const {
  const auto& [a, b] = surfaces_.edges()[at(edge)].vertex;
  return (block(begin_, b) - block(begin_, a)).norm();
}

double RoundPoints::chord(double radius, double other) const {
  return std::sqrt(kChord * radius * (candidate_.apart - radius - other));
}

bool RoundPoints::next(double reach, Found& found) {
  while (advance()) {
    const bool is_there = candidate_.kind != PairKind::vertex_face ? edge_point(found)
                          : rim_ < 0                               ? face_point(found)
                                                                   : rim_point(found);
    if (is_there && found.distance < reach) return true;
  }
  return false;
}

std::int32_t RoundPoints::number() const {
  const std::int32_t i = i_ * (kFinest / division_.finer);
  if (candidate_.kind != PairKind::vertex_face) return i;
  return rim_ < 0 ? i * kRow + j_ * (kFinest / division_.finer) : kInside + rim_ * kRow + i;
}

/// To the next point, which may be one that another face has; false: there is none.
bool RoundPoints::advance() {
  if (candidate_.kind != PairKind::vertex_face) return ++i_ < division_.all();
  if (rim_ < 0) {
    if (i_ + ++j_ < division_.all()) return true;
    j_ = 1;
    if (++i_ + j_ < division_.all()) return true;
  } else if (++i_ < division_.all()) {
    return true;
  }
  while (++rim_ < 3) {
    begin_rim();
    if (i_ < division_.all()) return true;
  }
  return false;
}

/// Before the points of an edge, none of which belong to a face that is not its first.
void RoundPoints::begin_rim() {
  i_ = 1;
  division_ = {1, 1};
  const std::int32_t e = surfaces_.triangle_edges(candidate_.b)[at(rim_)];
  const SurfaceEdge& edge = surfaces_.edges()[at(e)];
  if (edge.face[0] != candidate_.b) return;
  const double radius = surfaces_.vertices()[at(candidate_.vertex[0])].radius;
  const double other = surfaces_.vertices()[at(edge.vertex[0])].radius;
  const std::int32_t parts =
      std::clamp(parts_of(edge.length, radius, candidate_.apart - radius - other), 1, kMost);
  division_ = divided(parts, chord(radius, other), length_at_begin(e));
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

bool RoundPoints::face_point(Found& found) const {
  const auto& [v, a, b, c] = candidate_.vertex;
  const Vec3 normal = (place(b) - place(a)).cross(place(c) - place(a));
  const bool closed = surfaces_.surfaces()[at(surfaces_.vertices()[at(a)].surface)].closed;
  const double part = 1.0 / division_.all();
  const std::int32_t k = division_.all() - i_ - j_;
  if (!meet(candidate_.vertex, {1.0, -part * i_, -part * j_, -part * k}, part * part * normal.norm(),
            found)) {
    return false;
  }
  return !closed || normal.dot(found.r) > 0.0;
}

bool RoundPoints::rim_point(Found& found) const {
  const std::int32_t e = surfaces_.triangle_edges(candidate_.b)[at(rim_)];
  const SurfaceEdge& edge = surfaces_.edges()[at(e)];
  const double share = static_cast<double>(i_) / division_.all();
  const double area = surfaces_.vertices()[at(edge.vertex[0])].area / division_.all();
  return meet({candidate_.vertex[0], edge.vertex[0], edge.vertex[1], -1}, {1.0, share - 1.0, -share, 0.0},
              area, found);
}

/// A point of the edge that has faces, before the inside of the lone one.
bool RoundPoints::edge_point(Found& found) const {
  const bool is_first = surfaces_.edges()[at(candidate_.a)].is_lone();
  const auto& [a, b, c, d] = candidate_.vertex;
  const Vec3 from = place(is_first ? a : c);
  const Vec3 along = place(is_first ? b : d) - from;
  const double share = static_cast<double>(i_) / division_.all();
  const Vec3 point = (1.0 - share) * place(is_first ? c : a) + share * place(is_first ? d : b);
  const double t = (point - from).dot(along) / along.squaredNorm();
  if (!(t > 0.0 && t < 1.0)) return false;
  const double first = is_first ? t : share;
  const double second = is_first ? share : t;
  const double area = surfaces_.vertices()[at(is_first ? c : a)].area / division_.all();
  return meet(candidate_.vertex, {1.0 - first, first, second - 1.0, -second}, area, found);
}

}  // namespace tissu
