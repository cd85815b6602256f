#pragma once

#include <vector>

#include "tissu/edit/cut_state.h"
#include "tissu/force/load.h"

namespace tissu {

/// What is left of a face of the first day.
struct FaceLeft {
  double share = 0.0;  ///< of its area that has material
  std::vector<FacePart> parts;
};

/// Of each face of the first day, face after face, the faces of cells that lie in it and have material there
/// now, but for what cuts have opened. Faces of volumes, sheets themselves, and edges of flat bodies. Where
/// cuts or repairs have moved nodes, a face counts as a whole as long as any of it is there.
std::vector<FaceLeft> faces_left(const CutState& cut, const std::vector<FaceCells>& faces);

}  // namespace tissu
