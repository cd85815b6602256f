#pragma once

/// Cells that a blade passes more than once, as with walls that are nearer to each other than a cell.

#include <cstdint>
#include <functional>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/near.h"
#include "edit/cut/patch.h"

namespace tissu {

/// Divides edges that lead from a vertex on the cut through another sheet of the blade, and then their parts
/// and neighbours that do, near cells where the blade turns by more than 60 degrees. `share`: of an edge of a
/// cell of the patch, as divide_crossed takes it.
void divide_at_other_sheets(Patch& patch, const SweepPart& part, const NearCells& near, double t0,
                            const std::function<double(std::int32_t)>& share, OnCut& known);

/// After a part of a sweep was cut: cells (places, ascending) near which the blade turns by more than 60
/// degrees, and where it left material joined that it divides. There an edge goes from one sheet of the blade
/// through another, or a face lies between two sheets and on neither.
std::vector<std::int32_t> bridged_cells(const Patch& patch, const SweepPart& part, const NearCells& near,
                                        double t0, const OnCut& known,
                                        const std::vector<std::int32_t>& uncovered);

}  // namespace tissu
