#pragma once

/// What elements keep of their rest shape, in the order and the lanes of the kernels.

#include <span>
#include <string>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/cell/element_order.h"
#include "tissu/element/reference_cell.h"

namespace tissu {

/// J = sum_a X_a (x) dN_a/dxi (3 x m) = Q R with Q orthonormal; a volume has Q = I, or R upper triangular. A
/// cell whose J is the same everywhere is affine; where all cells are, one J each is kept.
struct RestShape {
  AlignedVector<double> rest;  ///< [group][rest point][reals][8]: R^-1 row by row, then volume [m3]
  std::size_t reals = 0;       ///< m m + 1; 7 when the upper triangle of R^-1 is kept
  AlignedVector<double>
      frames;           ///< [group][rest point][3][3][8]: Q and its complement; empty when Q = I serves
  int rest_points = 0;  ///< 1, or all points of the rule
  std::vector<double> weights;    ///< [point]: share of the volume in `rest` that belongs to the point
  std::vector<double> volumes;    ///< of each cell [m3]
  std::vector<std::int32_t> bad;  ///< cells that are inverted or have no volume at some point, ascending
};

/// The cells of a block and where they are.
struct RestCells {
  const ReferenceCell& reference;
  const std::vector<std::int32_t>& nodes;  ///< cell after cell
  const std::vector<double>&
      cross_section;  ///< of each cell, or one: thickness [m] or area [m2]; 1 for volumes
  ConstReals X;
  const std::vector<double>& share;  ///< of each cell, or one: how much of its volume is material
};

/// What of Q R is kept.
struct RestForm {
  bool frames = false;      ///< a law is not blind to rotation, so that cells below three dimensions need Q
  bool triangular = false;  ///< no law sees Q, so that a volume keeps R^-1 as a triangle
};

RestShape rest_shape(const RestCells& cells, const ElementOrder& order, RestForm form);

/// Lays some groups of volume cells anew, which are affine if the shape has one J for each cell.
void lay_rest(const RestCells& cells, const ElementOrder& order, std::span<const ElementOrder::Run> runs,
              RestShape& shape);

/// Which cells are affine, to round-off.
std::vector<char> affine_cells(const ReferenceCell& reference, const std::vector<std::int32_t>& cells,
                               ConstReals X);

}  // namespace tissu
