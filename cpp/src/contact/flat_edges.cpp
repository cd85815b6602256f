#include "flat_edges.h"

#include <array>

namespace tissu {
namespace {

constexpr double kFlat = 1e-6;  ///< sine of the angle between two faces

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Vec3 normal_of(const SurfaceSet& surfaces, std::int32_t face) {
  const auto& [a, b, c] = surfaces.primitives()[at(face)].vertex;
  const ConstReals rest(surfaces.rest());
  return (block(rest, b) - block(rest, a)).cross(block(rest, c) - block(rest, a));
}

/// A plane that is folded onto itself along the edge is not one plane.
bool lies_on_both_sides(const SurfaceSet& surfaces, const SurfaceEdge& e) {
  const ConstReals rest(surfaces.rest());
  const Vec3 from = block(rest, e.vertex[0]);
  const Vec3 along = (block(rest, e.vertex[1]) - from).normalized();
  std::array<Vec3, 2> into;
  for (std::size_t side = 0; side < 2; ++side) {
    into[side] = block(rest, e.across[side]) - from;
    into[side] -= along.dot(into[side]) * along;
  }
  return into[0].dot(into[1]) < 0.0;
}

}  // namespace

bool is_flat_edge(const SurfaceSet& surfaces, std::int32_t edge) {
  const SurfaceEdge& e = surfaces.edges()[at(edge)];
  if (e.face[1] < 0 || surfaces.vertices()[at(e.vertex[0])].is_soft()) return false;
  const Vec3 first = normal_of(surfaces, e.face[0]);
  const Vec3 second = normal_of(surfaces, e.face[1]);
  const double sizes = first.norm() * second.norm();
  return sizes > 0.0 && first.cross(second).norm() <= kFlat * sizes && lies_on_both_sides(surfaces, e);
}

bool is_before_neighbour(const SurfaceSet& surfaces, ConstReals places, const Candidate& candidate,
                         const Closest& closest) {
  if (surfaces.vertices()[at(candidate.vertex[1])].is_soft()) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t across = 1 + (i + 2) % 3;
    if (closest.beta[across] != 0.0) continue;  // the nearest point is not on this edge
    const std::int32_t e = surfaces.triangle_edges(candidate.b)[i];
    if (!is_flat_edge(surfaces, e)) continue;
    const Vec3 from = block(places, candidate.vertex[1 + i]);
    const Vec3 along = (block(places, candidate.vertex[1 + (i + 1) % 3]) - from).normalized();
    Vec3 into = block(places, candidate.vertex[across]) - from;
    into -= along.dot(into) * along;
    const double beyond = -closest.r.dot(into);
    // On the edge itself the first face meets the vertex.
    if (beyond > 0.0 || (beyond == 0.0 && surfaces.edges()[at(e)].face[0] != candidate.b)) return true;
  }
  return false;
}

}  // namespace tissu
