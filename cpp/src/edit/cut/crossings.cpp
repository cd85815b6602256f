#include "edit/cut/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_set>

#include "tissu/base/crossing.h"
#include "tissu/base/exact.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

using Triangle = std::array<Vec3, 3>;
using Numbers = std::span<const std::int32_t>;

constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Distance to the triangle's plane, never negative.
double height(const Triangle& t, const Vec3& p) {
  return std::abs((t[1] - t[0]).cross(t[2] - t[0]).normalized().dot(p - t[0]));
}

/// Whether the line through a and b passes the closed triangle, for a and b on different sides.
bool passes(const Triangle& triangle, const Vec3& a, const Vec3& b) {
  bool above = false;
  bool below = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int turn = orientation(a, b, triangle[i], triangle[(i + 1) % 3]);
    above = above || turn > 0;
    below = below || turn < 0;
  }
  return !(above && below);
}

class Finder {
 public:
  Finder(const Patch& patch, const SweepPart& part, double t0, OnCut& known)
      : patch_(patch), part_(part), t0_(t0), known_(known) {}

  void look_at(std::int32_t p, std::int32_t q, Numbers triangles) {
    if (p > q) std::swap(p, q);
    const std::uint64_t key = (static_cast<std::uint64_t>(p) << 32U) | static_cast<std::uint64_t>(q);
    if (!seen_.insert(key).second) return;
    const Vec3& a = patch_.vertex(p).place;
    const Vec3& b = patch_.vertex(q).place;
    CrossedEdge edge{p, q, {}};
    const bool at_wall = known_[p].wall || known_[q].wall;
    for (const std::int32_t t : triangles) {
      if (at_wall && t < part_.fresh) continue;  // that way parted the wall
      const Triangle& triangle = part_.triangles[at(t)];
      const int side_a = orientation(triangle[0], triangle[1], triangle[2], a);
      const int side_b = orientation(triangle[0], triangle[1], triangle[2], b);
      if (side_a == 0 && crosses(a, a, triangle)) known_.put_on(p, a, a, t);
      if (side_b == 0 && crosses(b, b, triangle)) known_.put_on(q, b, b, t);
      if (side_a * side_b >= 0 || !passes(triangle, a, b)) continue;
      const double of_a = height(triangle, a);
      const double sum = of_a + height(triangle, b);
      edge.crossings.push_back({sum > 0.0 ? of_a / sum : 0.5, side_a, t});
    }
    if (!edge.crossings.empty()) edges_.push_back(std::move(edge));
  }

  std::vector<CrossedEdge> take() {
    std::erase_if(edges_, [&](CrossedEdge& edge) {
      if (known_.on(edge.p) || known_.on(edge.q)) return true;
      settle(edge.crossings, t0_);
      if (edge.crossings.empty()) return true;
      cast_votes(patch_, edge, known_);
      return false;
    });
    return std::move(edges_);
  }

 private:
  const Patch& patch_;
  const SweepPart& part_;
  double t0_;
  OnCut& known_;
  std::unordered_set<std::uint64_t> seen_;
  std::vector<CrossedEdge> edges_;
};

}  // namespace

void settle(std::vector<BladeCrossing>& crossings, double t0) {
  std::ranges::sort(crossings, [](const BladeCrossing& a, const BladeCrossing& b) {
    return a.t != b.t ? a.t < b.t : a.direction < b.direction;
  });
  std::vector<BladeCrossing> kept;
  for (const BladeCrossing& next : crossings) {
    if (!kept.empty() && next.t - kept.back().t <= t0) {
      if (next.direction != kept.back().direction) kept.pop_back();
    } else {
      kept.push_back(next);
    }
  }
  crossings = std::move(kept);
}

void cast_votes(const Patch& patch, const CrossedEdge& edge, OnCut& known) {
  const Vec3& a = patch.vertex(edge.p).place;
  const Vec3& b = patch.vertex(edge.q).place;
  const auto cast = [&](std::int32_t v, const BladeCrossing& crossing, int sign) {
    known.vote(v, (1.0 - crossing.t) * a + crossing.t * b, sign * crossing.direction, crossing.triangle);
  };
  cast(edge.p, edge.crossings.front(), 1);
  cast(edge.q, edge.crossings.back(), -1);
}

void OnCut::vote(std::int32_t v, const Vec3& place, int direction, std::int32_t triangle) {
  Vertex& vertex = vertices[at(v)];
  vertex.votes += direction;
  meetings.push_back({triangle, false, place, direction, vertex.last});
  vertex.last = static_cast<std::int32_t>(meetings.size()) - 1;
}

void OnCut::put_on(std::int32_t v, const Vec3& place, const Vec3& met, std::int32_t triangle) {
  Vertex& vertex = vertices[at(v)];
  vertex.on = true;
  bool is_known = triangle < 0;
  each_meeting(v, [&](const Meeting& one) { is_known = is_known || (one.on && one.triangle == triangle); });
  if (!is_known) {
    meetings.push_back({triangle, true, met, 0, vertex.last});
    vertex.last = static_cast<std::int32_t>(meetings.size()) - 1;
  }
  const double away = (met - place).norm();
  if (away >= vertex.away) return;
  vertex.away = away;
  vertex.met = met;
}

std::vector<CrossedEdge> crossed_edges(const Patch& patch, const SweepPart& part, const NearCells& near,
                                       double t0, OnCut& known) {
  Finder finder(patch, part, t0, known);
  std::int32_t cell = -1;
  Numbers triangles;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    if (tetra.cell != cell) triangles = near.triangles(patch.cell(cell = tetra.cell).number);
    if (triangles.empty()) continue;
    for (const auto& [i, j] : kEdges) {
      if (tetra.vertices[j] >= 0) finder.look_at(tetra.vertices[i], tetra.vertices[j], triangles);
    }
  }
  return finder.take();
}

}  // namespace tissu
