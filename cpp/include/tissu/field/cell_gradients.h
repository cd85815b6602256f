#pragma once

/// The gradient that a cell has of what its nodes know.

#include <span>
#include <string_view>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// grad N_a at rest of each cell and node [cell][node][3], 1/m: the mean over the points of the cell's full
/// quadrature, so that sum_a X_a (x) grad N_a = I. Throws MeshError for elements below three dimensions and
/// cells without volume.
std::vector<double> mean_gradients(std::string_view element, ConstReals positions,
                                   std::span<const std::int32_t> cells);

}  // namespace tissu
