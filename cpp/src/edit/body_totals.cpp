#include "tissu/edit/body_totals.h"

#include <numeric>

namespace tissu {

BodyTotals totals(const World& world, const State& state, std::string_view name) {
  BodyTotals result;
  const Body& body = world.body(name);
  for (std::int32_t row = body.first_node; row < body.first_node + body.node_count; ++row) {
    const double m = world.mass().nodal()[static_cast<std::size_t>(row)];
    const Vec3 p = m * block(ConstReals(state.velocities), row);
    const Vec3 x = block(ConstReals(state.positions), row);
    result.mass += m;
    result.momentum += p;
    result.angular_momentum += x.cross(p);
    if (m > 0.0) result.kinetic += 0.5 * p.squaredNorm() / m;
  }
  Scratch scratch;
  for (const BodyModel* model : body.models) {
    result.elastic += model->energy(state, scratch);
    result.volume = std::accumulate(model->volumes().begin(), model->volumes().end(), result.volume);
  }
  return result;
}

}  // namespace tissu
