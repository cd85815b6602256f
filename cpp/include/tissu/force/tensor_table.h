#pragma once

/// Picinbono's constants where he keeps them: on the nodes, edges, faces and tetrahedra of a mesh, each the
/// sum of what the tetrahedra around it give. The energy is
///   W = sum 1/2 u_a . B^ab u_b + sum (u_a . C^abc) (u_b . u_c) + sum D^abcd (u_a . u_b) (u_c . u_d)      [J]
///   B^ab   = V (lambda g_a (x) g_b + mu g_b (x) g_a + mu (g_a . g_b) I)
///   C^abc  = V (lambda/2 g_a (g_b . g_c) + mu/2 (g_c (g_a . g_b) + g_b (g_a . g_c)))
///   D^abcd = V (lambda/8 (g_a . g_b) (g_c . g_d) + mu/4 (g_a . g_d) (g_b . g_c))
/// with g_a the gradients of the shape functions of a tetrahedron of volume V; terms stand with the set of
/// nodes that they name. Each constant is kept times the number of terms that it serves, and where two are
/// met as a sum only, both are kept, as published: 13 numbers on a node, 26 on an edge, 18 on a face, 6 on a
/// tetrahedron. Hooke has B only: 9 on a node and 9 on an edge.
///
/// Picinbono, Delingette, Ayache 2001; Faure 2014, eq. 2.16, 2.17 and table 2.1, where the volume and the
/// factor of B are wrong.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/base/vec.h"
#include "tissu/force/element_order.h"
#include "tissu/law/law.h"

namespace tissu {

/// A tetrahedron at rest.
struct TensorCell {
  std::array<Vec3, 4> g;
  double volume;
  Lame lame;
};
/// That of a cell by its number.
using TensorCellOf = std::function<TensorCell(std::int32_t)>;

/// The cells, four nodes each, as they stand.
using TensorCells = std::span<const std::int32_t>;

/// All nodes (size 1), edges (2), faces (3) or tetrahedra (4) with their constants.
struct TensorTable {
  int size = 0;
  int reals = 0;
  std::vector<std::int32_t> nodes;  ///< one after the other, each with its nodes ascending, in their order
  ElementOrder order;
  AlignedVector<double> constants;    ///< [group][reals][8]
  AlignedVector<std::int32_t> slots;  ///< [group][a][b][8], blocks of the matrix
  std::size_t computed =
      0;  ///< constants that were summed up when it was made; an edit takes over the others

  [[nodiscard]] std::size_t bytes() const;
};

/// `reals` is 9 for Hooke.
TensorTable tensor_table(int size, int reals, TensorCells cells, const TensorCellOf& cell_of, ConstReals X);

/// The table without some cells, given as they were; `cells` are those left. Only constants of nodes, edges,
/// faces and tetrahedra of the removed cells are summed up again, and in the order that `tensor_table` has,
/// so that it comes to the same bits.
TensorTable without(const TensorTable& before, TensorCells removed, TensorCells cells,
                    const TensorCellOf& cell_of, ConstReals X);

}  // namespace tissu
