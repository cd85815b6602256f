#pragma once

#include <span>
#include <string_view>

#include "tissu/state/state.h"
#include "tissu/world/world.h"

namespace tissu {

/// What a cut keeps of a body, so that a report can say how far it did.
struct BodyTotals {
  double volume = 0.0;                   ///< of the material at rest [m3]
  double mass = 0.0;                     ///< [kg]
  Vec3 momentum = Vec3::Zero();          ///< [kg m/s]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the origin [kg m2/s]
  double kinetic = 0.0;                  ///< [J]
  double elastic = 0.0;                  ///< [J]
};
BodyTotals totals(const World& world, const State& state, std::string_view body);
/// The mass of a body's own material [kg]. The lumped masses of its nodes are more where tissue follows them.
double material_mass(const World& world, std::string_view body);
/// Those of the masses of some rows: no volume, and no elastic energy.
BodyTotals totals(const World& world, const State& state, std::span<const std::int32_t> rows);

}  // namespace tissu
