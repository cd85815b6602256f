#include "tissu/edit/body_totals.h"

#include <algorithm>
#include <numeric>

namespace tissu {

BodyTotals totals(const World& world, const State& state, std::span<const std::int32_t> rows) {
  BodyTotals result;
  for (const std::int32_t row : rows) {
    const double m = world.mass().nodal()[static_cast<std::size_t>(row)];
    const Vec3 p = m * block(ConstReals(state.velocities), row);
    const Vec3 x = block(ConstReals(state.positions), row);
    result.mass += m;
    result.momentum += p;
    result.angular_momentum += x.cross(p);
    if (m > 0.0) result.kinetic += 0.5 * p.squaredNorm() / m;
  }
  return result;
}

namespace {

/// Of nodes that have rotations.
void add_spins(const World& world, const State& state, const Body& body, BodyTotals& result) {
  for (std::int32_t node = 0; body.first_frame >= 0 && node < body.node_count; ++node) {
    const auto k = static_cast<std::size_t>(body.first_frame + node);
    const Frame& frame = world.frames()[k];
    const Vec3 omega = block(ConstReals(state.velocities), frame.rotation);
    const Vec3 spin = spatial_inertia(frame, state.rotations[k]) * omega;
    result.angular_momentum += spin;
    result.kinetic += 0.5 * omega.dot(spin);
  }
}

bool has_tissue(const World& world) {
  const WorldDescription* description = world.description();
  return description == nullptr || std::ranges::any_of(description->bodies, [](const BodyDescription& body) {
           return !body.shared.empty();
         });
}

}  // namespace

double material_mass(const World& world, std::string_view name) {
  const Body& body = world.body(name);
  std::vector<double> own;
  if (has_tissue(world)) {
    own.assign(static_cast<std::size_t>(world.blocks()), 0.0);
    for (const BodyModel* model : body.models) model->add_masses(own);
    return std::accumulate(own.begin(), own.end(), 0.0);
  }
  const auto first = world.mass().nodal().begin() + body.first_node;
  return std::accumulate(first, first + body.node_count, 0.0);
}

BodyTotals totals(const World& world, const State& state, std::string_view name) {
  const Body& body = world.body(name);
  std::vector<std::int32_t> rows(static_cast<std::size_t>(body.node_count));
  std::iota(rows.begin(), rows.end(), body.first_node);
  BodyTotals result = totals(world, state, rows);
  add_spins(world, state, body, result);
  Scratch scratch;
  for (const BodyModel* model : body.models) {
    result.elastic += model->energy(state, scratch);
    result.volume = std::accumulate(model->volumes().begin(), model->volumes().end(), result.volume);
  }
  return result;
}

}  // namespace tissu
