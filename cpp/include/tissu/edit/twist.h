#pragma once

/// Momenta that an edit changed are given back.

#include <cstdint>
#include <span>

#include "tissu/base/vec.h"
#include "tissu/world/world.h"

namespace tissu {

/// Adds to the velocities of some rows the velocity of a rigid body, by which their momentum grows by
/// `momentum` [kg m/s] and their angular momentum about the origin by `angular` [kg m2/s]. Held rows keep
/// theirs. Rows in one line, or in one place, take the momentum alone; without a free row nothing changes.
/// `positions`, `velocities`: of all rows.
void add_twist(const World& world, std::span<const std::int32_t> rows, const Vec3& momentum,
               const Vec3& angular, ConstReals positions, Reals velocities);

}  // namespace tissu
