#pragma once

/// The repair of a body of a world.

#include <optional>
#include <string_view>

#include "tissu/edit/cut_body.h"
#include "tissu/edit/repair/plan_repair.h"
#include "tissu/state/state.h"
#include "tissu/world/world.h"

namespace tissu {

/// Refuses a body without tetrahedra of first order, with parts of cells, and one whose cells remember.
void refuse_unrepaired(const World& world, std::string_view body);
RepairPlan plan_body_repair(const World& world, const State& state, std::string_view body,
                            const RepairOptions& options);
/// A new world in which the plan is made; `around_moves` are the rows of all cells that it changes. Nothing
/// where the body would cross itself in contact.
std::optional<CutWorld> repaired_world(const World& world, const State& state, std::string_view body,
                                       const CutPlan& plan);

}  // namespace tissu
