#pragma once

#include "tissu/state/state.h"
#include "tissu/world/world.h"

namespace tissu {

/// How a node's neighbours have turned about it since the rest shape: the rotation R of the polar
/// decomposition of sum_j (x_j - x_i) (X_j - X_i)^T over the rows that the matrix couples with it (Müller,
/// Heidelberger, Teschner, Gross 2005). The identity where they span no volume.
Mat3 turn_of(const World& world, const State& state, std::int32_t row);

}  // namespace tissu
