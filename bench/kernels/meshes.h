#pragma once

/// Meshes of one element type each for the rows of the kernels: about the same number of elements, nodes
/// shared, the corners inside moved a little so that cells are not affine where their type allows it.

#include <cstdint>
#include <string_view>
#include <vector>

namespace tissu::bench {

struct ElementMesh {
  int nodes_per_cell = 0;
  std::vector<double> positions;    ///< 3 numbers per node [m]
  std::vector<std::int32_t> cells;  ///< cell after cell

  [[nodiscard]] std::int32_t node_count() const { return static_cast<std::int32_t>(positions.size() / 3); }
  [[nodiscard]] std::int32_t cell_count() const {
    return static_cast<std::int32_t>(cells.size()) / nodes_per_cell;
  }
};

/// About `count` elements on a grid of 1 cm: grid cells cut into six tetrahedra, two wedges or six pyramids;
/// triangles and quadrangles as a membrane that is not flat, lines along the rows of a grid. Elements of
/// second order have their further nodes in the middles of edges, faces and cells. No nodes when the element
/// is unknown.
ElementMesh element_mesh(std::string_view element, int count);

/// The mesh stretched, sheared and bent by some percent, as positions [m].
std::vector<double> deformed(const ElementMesh& mesh);

}  // namespace tissu::bench
