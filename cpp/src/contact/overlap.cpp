#include "overlap.h"

#include <algorithm>
#include <cmath>

#include "nearest_pair.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

void add(std::int32_t a, std::int32_t b, double depth, Depths& depths) {
  double& deepest = depths[std::minmax(a, b)];
  deepest = std::max(deepest, depth);
}

}  // namespace

Depths deep_overlaps(const Contact& contact, const Candidates& candidates, ConstReals places,
                     const State& state, double gaps) {
  Depths depths;
  const auto& vertices = contact.surfaces().vertices();
  const ContactDescription& description = contact.description();
  for (const Candidate& c : candidates.list()) {
    const std::int32_t own = vertices[at(c.vertex[0])].surface;
    const std::int32_t other = vertices[at(c.vertex[at(vertices_of_first(c.kind))])].surface;
    const double gap = description.pairs[at(c.pair)].gap;
    const double thick = c.apart - gap;
    if (!(thick > 0.0)) continue;
    std::array<Vec3, 4> p{};
    for (int k = 0; k < vertices_of(c.kind); ++k) p[at(k)] = block(places, c.vertex[at(k)]);
    const double depth = thick - std::sqrt(nearest_of(c.kind, p).square);
    if (depth > gaps * gap) add(own, other, depth, depths);
  }
  const auto bodies = static_cast<std::int32_t>(description.bodies.size());
  for (const PlaneCandidate& c : candidates.planes()) {
    const double gap = description.pairs[at(c.pair)].gap;
    const double thick = c.apart - gap;
    if (!(thick > 0.0)) continue;
    const Vec3 origin =
        contact.place_of(c.obstacle, description.obstacles[at(c.obstacle)].origin, state, state.time);
    const Vec3 normal = contact.normal_of(c.obstacle, state, state.time);
    const double depth = thick - normal.dot(block(places, c.vertex) - origin);
    if (depth > gaps * gap) add(vertices[at(c.vertex)].surface, bodies + c.obstacle, depth, depths);
  }
  return depths;
}

Depths overlaps(const Contact& contact, const State& state) {
  std::vector<double> places(3 * contact.surfaces().vertices().size());
  contact.place_vertices(state, state.time, places);
  Candidates candidates(contact.description(), contact.surfaces());
  candidates.cover(places, places);
  return deep_overlaps(contact, candidates, places, state, 0.0);
}

}  // namespace tissu
