#pragma once

/// Where a blade enters the material without crossing an edge of it.

#include <cstdint>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/crowded.h"
#include "edit/cut/near.h"
#include "edit/cut/patch.h"

namespace tissu {

/// Places of tetrahedra, ascending, that the blade enters or whose faces it passes, without crossing an edge
/// or meeting a vertex of them. A line is crossed or not met.
/// `in_whole_cells`: not in cells that are divided or opened.
std::vector<std::int32_t> pierced_tetrahedra(const Patch& patch, const SweepPart& part, const NearCells& near,
                                             const OnCut& known, bool in_whole_cells);

/// Cells (places, ascending) that a sheet of the blade enters in this way inside its border, as a cylinder
/// does that is narrower than a cell, though the blade cuts them elsewhere: farther from the cut than that
/// share of the cell's longest edge. At the border of a blade the front of a cut may lag behind it.
std::vector<std::int32_t> cells_pierced_between(const Patch& patch, const Blade& blade, const OnCut& known,
                                                double share);

}  // namespace tissu
