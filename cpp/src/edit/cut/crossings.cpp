#include "edit/cut/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_set>

#include "tissu/base/crossing.h"
#include "tissu/base/exact.h"

namespace tissu {
namespace {

using Triangle = std::array<Vec3, 3>;
using Numbers = std::span<const std::int32_t>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

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
    for (const std::int32_t t : triangles) {
      const Triangle& triangle = part_.triangles[at(t)];
      const int side_a = orientation(triangle[0], triangle[1], triangle[2], a);
      const int side_b = orientation(triangle[0], triangle[1], triangle[2], b);
      if (side_a == 0 && crosses(a, a, triangle)) known_.put_on(p, a, a);
      if (side_b == 0 && crosses(b, b, triangle)) known_.put_on(q, b, b);
      if (side_a * side_b >= 0 || !passes(triangle, a, b)) continue;
      const double of_a = height(triangle, a);
      const double sum = of_a + height(triangle, b);
      edge.crossings.push_back({sum > 0.0 ? of_a / sum : 0.5, side_a});
    }
    if (!edge.crossings.empty()) edges_.push_back(std::move(edge));
  }

  std::vector<CrossedEdge> take() {
    std::erase_if(edges_, [&](CrossedEdge& edge) {
      if (known_.on(edge.p) || known_.on(edge.q)) return true;
      settle(edge.crossings, t0_);
      if (edge.crossings.empty()) return true;
      known_.vertices[at(edge.p)].votes += edge.crossings.front().direction;
      known_.vertices[at(edge.q)].votes -= edge.crossings.back().direction;
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

/// Whether the border of one of the triangles enters a tetrahedron, or passes through a triangle. A line is
/// crossed or not met.
bool enters(const Patch& patch, const SweepPart& part, Numbers triangles, const Patch::Tetra& tetra) {
  if (tetra.corners() == 2) return false;
  std::array<Vec3, 4> corner;
  const bool solid = tetra.corners() == 4;
  for (std::size_t i = 0; i < tetra.corners(); ++i) corner[i] = patch.vertex(tetra.vertices[i]).place;
  const auto outside = [&](const Vec3& p) {
    return std::ranges::any_of(kOpposite, [&](const auto& face) {
      return orientation(corner[face[0]], corner[face[1]], corner[face[2]], p) > 0;
    });
  };
  for (const std::int32_t t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if ((part.border[at(t)] >> i & 1U) == 0) continue;
      const Vec3& from = part.triangles[at(t)][i];
      const Vec3& to = part.triangles[at(t)][(i + 1) % 3];
      if (!solid) {
        if (crosses(from, to, {corner[0], corner[1], corner[2]})) return true;
        continue;
      }
      if (!outside(from)) return true;
      for (const auto& face : kOpposite) {
        if (crosses(from, to, {corner[face[0]], corner[face[1]], corner[face[2]]})) return true;
      }
    }
  }
  return false;
}

}  // namespace

void settle(std::vector<Crossing>& crossings, double t0) {
  std::ranges::sort(crossings, [](const Crossing& a, const Crossing& b) {
    return a.t != b.t ? a.t < b.t : a.direction < b.direction;
  });
  std::vector<Crossing> kept;
  for (const Crossing& next : crossings) {
    if (!kept.empty() && next.t - kept.back().t <= t0) {
      if (next.direction != kept.back().direction) kept.pop_back();
    } else {
      kept.push_back(next);
    }
  }
  crossings = std::move(kept);
}

void OnCut::put_on(std::int32_t v, const Vec3& place, const Vec3& met) {
  Vertex& vertex = vertices[at(v)];
  vertex.on = true;
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

std::vector<std::int32_t> pierced_tetrahedra(const Patch& patch, const SweepPart& part, const NearCells& near,
                                             const OnCut& known) {
  std::vector<std::int32_t> pierced;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    const auto met = [&](std::int32_t v) { return v >= 0 && known.on(v); };
    if (std::ranges::any_of(tetra.vertices, met)) continue;
    const Numbers triangles = near.triangles(patch.cell(tetra.cell).number);
    if (!triangles.empty() && enters(patch, part, triangles, tetra)) {
      pierced.push_back(static_cast<std::int32_t>(t));
    }
  }
  return pierced;
}

}  // namespace tissu
