#pragma once

/// A cut as an edit of the body.

#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/model/cell_edit.h"

namespace tissu {

/// Nodes without material: those from before, old ones that lose it, and new ones that never have any.
std::vector<std::int32_t> bare_after(const std::vector<std::int32_t>& before, const CutPlan& plan);

/// The cells of a plan.
void set_cells(const CutPlan& plan, CellEdit& edit);

}  // namespace tissu
