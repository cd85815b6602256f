#pragma once

#include <vector>

#include "tissu/edit/cut_state.h"
#include "tissu/force/load.h"

namespace tissu {

/// Which share of the area of each face of the first day still has material, face after face: 1 unless cells
/// are gone. Faces of volumes, sheets themselves, and edges of flat bodies. Where cuts or repairs have moved
/// nodes, a face counts as a whole as long as any of it is there.
std::vector<double> shares_left(const CutState& cut, const std::vector<FaceCells>& faces);

}  // namespace tissu
