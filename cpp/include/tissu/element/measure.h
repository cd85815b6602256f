#pragma once

/// Lengths, areas and volumes of cells by their shape functions.

#include <span>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/element/reference_cell.h"

namespace tissu {

/// sum_g w_g sqrt(det(J^T J)) of each cell [m^m], never negative; `nodes` are cell after cell.
std::vector<double> measures(const ReferenceCell& reference, std::span<const std::int32_t> nodes,
                             ConstReals positions);

}  // namespace tissu
