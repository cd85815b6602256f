#pragma once

/// The cells around nodes that a plan moved.

#include <cstdint>
#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/hosts.h"

namespace tissu {

/// Nodes of the cells at nodes that the plan moved, and at copies of these, ascending. `after`: the plan.
std::vector<std::int32_t> nodes_around_moves(const Hosts& after, const CutPlan& plan);

/// Nodes of the cells that the plan makes or gives other nodes, and of those at nodes that it moved,
/// ascending. `after`: the plan.
std::vector<std::int32_t> nodes_around_changes(const Hosts& after, const CutPlan& plan);

/// The least quality 6 sqrt(2) V / l_rms^3 at rest of the tetrahedra that a plan made or whose nodes it
/// moved; infinite where there is none.
double least_quality(const Hosts& after, const CutPlan& plan);

}  // namespace tissu
