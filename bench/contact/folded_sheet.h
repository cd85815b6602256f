#pragma once

#include <vector>

#include "tissu/contact/boxes.h"

namespace tissu::bench {

/// Boxes of the triangles of a square sheet of edges of length 1, `cells` a side, folded into layers that are
/// `apart` from each other; a wave goes through it in time. Boxes are grown by `grown`.
std::vector<Box> folded_sheet(int cells, int layers, double apart, double grown, double time);

}  // namespace tissu::bench
