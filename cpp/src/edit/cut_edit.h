#pragma once

/// A cut as an edit of the body.

#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/model/cell_edit.h"
#include "tissu/world/description.h"

namespace tissu {

/// Nodes without material: those from before, old ones that lose it, and new ones that never have any.
std::vector<std::int32_t> bare_after(const std::vector<std::int32_t>& before, const CutPlan& plan);

/// The places of nodes on edges as a description has them.
FirstDayPoint first_day_point(const Rider& rider);
std::vector<FirstDayPoint> first_day_points(const Hosts& hosts);

/// Of each new node of a plan, as an edit has it: the node that it copies; -1 - i: it is at point i. `after`
/// has the plan.
std::vector<std::int32_t> copied_by(const Hosts& after, const CutPlan& plan);

/// The cells of a plan.
void set_cells(const CutPlan& plan, CellEdit& edit);

}  // namespace tissu
