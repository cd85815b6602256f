#pragma once

/// Cells that a blade passes more than once, as with walls that are nearer to each other than a cell.

#include <cstdint>
#include <functional>
#include <vector>

#include "edit/cut/bisect.h"
#include "edit/cut/crossings.h"
#include "edit/cut/crowded.h"
#include "edit/cut/patch.h"

namespace tissu {

/// Divides edges that lead from a vertex on the cut through another sheet of the blade, and then their parts
/// and neighbours that do, in crowded cells. `share`: of an edge of a cell of the patch, as divide_crossed
/// takes it. Returns the cells (places) of edges that were left.
LeftEdges divide_at_other_sheets(Patch& patch, const Blade& blade, double settled, double t0,
                                 const std::function<double(std::int32_t)>& share, OnCut& known);

/// After a part of a sweep was cut: crowded cells (places, ascending) where it left material joined that it
/// divides. There an edge goes through a sheet of the blade on which it does not end, or passes two sheets
/// that are too near to each other.
std::vector<std::int32_t> bridged_cells(const Patch& patch, const Blade& blade, double settled,
                                        const OnCut& known);

}  // namespace tissu
