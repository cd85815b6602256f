#pragma once

/// Picinbono's constants where he keeps them: on the nodes, edges, faces and tetrahedra of a mesh, each the
/// sum of what the tetrahedra around it give.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/base/vec.h"
#include "tissu/cell/element_order.h"
#include "tissu/model/edges/tensor_constants.h"

namespace tissu {

/// That of a cell by its number.
using TensorCellOf = std::function<TensorCell(std::int32_t)>;

/// The cells, four nodes each, as they stand.
using TensorCells = std::span<const std::int32_t>;

/// All nodes (size 1), edges (2), faces (3) or tetrahedra (4) with their constants.
struct TensorTable {
  int size = 0;
  int reals = 0;
  /// One after the other, each with its nodes ascending, in their order; also those that edits have taken
  /// out.
  std::vector<std::int32_t> nodes;
  ElementOrder order;
  AlignedVector<double> constants;    ///< [group][reals][8]
  AlignedVector<std::int32_t> slots;  ///< [group][a][b][8], blocks of the matrix
  std::size_t computed =
      0;  ///< constants that were summed up when it was made; an edit takes over the others

  [[nodiscard]] std::size_t bytes() const;
  /// Constants of what is still there.
  [[nodiscard]] std::size_t held() const;
};

/// `reals` is 9 for Hooke.
TensorTable tensor_table(int size, int reals, TensorCells cells, const TensorCellOf& cell_of, ConstReals X);

/// The table without some cells, given as they were; `cells` are those left, on a world of so many nodes.
/// Only constants of nodes, edges, faces and tetrahedra of the removed cells are summed up again, in the
/// order that `tensor_table` has, so that they come to the same bits; all else is copied, and stands where it
/// stood.
TensorTable without(const TensorTable& before, TensorCells removed, TensorCells cells,
                    const TensorCellOf& cell_of, std::size_t nodes);

}  // namespace tissu
