#pragma once

/// The forces of a world in a state, and the matrices that its equation of motion is linearised with:
///   M dv/dt = f(x, v),   K = -df/dx,   D = -df/dv.
/// Rows are all there are, those of held nodes too. Made on request; a step makes its own.

#include <memory>
#include <vector>

#include "tissu/assembly/block_matrix.h"
#include "tissu/world/world.h"

namespace tissu {

/// A matrix, and the couplings that stand beside it.
struct AssembledMatrix {
  std::unique_ptr<BlockMatrix> blocks;
  Couplings couplings;
};

/// Of the body and its surroundings together [N], moments in rotation blocks [N m].
std::vector<double> total_force(const World& world, const State& state);
/// K [N/m]. Where a model has another tangent than its force's derivative, it is that tangent.
AssembledMatrix stiffness_matrix(const World& world, const State& state);
/// D [N s/m]
AssembledMatrix damping_matrix(const World& world, const State& state);
/// M, lumped [kg]; inertia in rotation blocks [kg m2].
AssembledMatrix mass_matrix(const World& world, const State& state);

}  // namespace tissu
