#pragma once

/// What elements keep of their rest shape, in the order and the lanes of the kernels.

#include <string>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/element/reference_cell.h"
#include "tissu/force/element_order.h"

namespace tissu {

struct RestShape {
  AlignedVector<std::int32_t> nodes;  ///< [group][node][8]
  AlignedVector<double> rest;         ///< [group][point][m m + 1][8]: J^-1 row by row, weight * det J [m3]
  std::vector<double> volumes;        ///< of each cell [m3]
  std::vector<std::int32_t> bad;      ///< cells that are inverted or have no volume at some point, ascending
};

/// `cells` holds cell after cell, node numbers into X.
RestShape rest_shape(const ReferenceCell& reference, const std::vector<std::int32_t>& cells,
                     const ElementOrder& order, ConstReals X);

}  // namespace tissu
