#pragma once

/// Which segments a blade severs.

#include <span>
#include <vector>

#include "tissu/edit/cut/sweep.h"

namespace tissu {

/// Whether a blade runs between the ends `a` and `b` of each segment, 3 numbers per point. The signs are
/// exact. A point on a triangle counts as one on the side of its normal, so that a blade through a point
/// parts it from what lies on the other side alone.
std::vector<char> severed(const Sweep& sweep, std::span<const double> a, std::span<const double> b);

}  // namespace tissu
