#include "tissu/contact/geometric.h"

#include <algorithm>
#include <cmath>

namespace tissu {

/// No force goes on from step to step.
void GeometricContact::begin_blow(Blow& blow, double /*pushed*/) const {
  blow.way = {};
  blow.end = {};
}

void GeometricContact::strike_way(ConstReals /*way*/, Reals change) { std::ranges::fill(change, 0.0); }

void GeometricContact::strike_end(ConstReals velocities, const State& end, Reals change) {
  std::ranges::fill(change, 0.0);
  for (Blow& blow : blows()) {
    const ContactNumbers& c = blow.contact;
    blow.end = {};
    if (!is_shut(blow, end)) continue;
    const Vec3 n = vector_of(c.normal);
    const Vec3 rate = run_.rate(c, velocities) + run_.rate(c, change) + run_.led(c) / h_;
    const double u = n.dot(rate);
    if (!(u < 0.0)) continue;
    blow.end.normal = -u / blow.weight;
    blow.end.along = on_disk(-(rate - u * n) / blow.tangent, blow.friction * blow.end.normal);
    mass_.give(c, blow.end.sum(n), change);
  }
}

void GeometricContact::keep(const State& end, std::vector<ContactNumbers>& kept) {
  ImpulseContact::keep(end, kept);
  for (ContactNumbers& c : kept) {
    c.force = 0.0;
    c.drag = {};
  }
}

}  // namespace tissu
