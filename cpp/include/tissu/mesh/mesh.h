#pragma once

/// A mesh: node positions and blocks of cells of one type each, in VTK's node order.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// The cell types there are; the names are those of meshio. Corners come first, then the middles of the
/// edges, of the faces and of the cell. The triangle 0 1 2 of a wedge looks towards 3 4 5, as in meshio.
enum class CellType : std::uint8_t {
  tetra,
  hexahedron,
  tetra10,
  hexahedron20,
  hexahedron27,
  wedge,
  wedge15,
  pyramid,
  pyramid13,
  triangle,
  triangle6,
  quad,
  quad8,
  quad9,
  line,
  line3
};

/// What is fixed by the type of a cell.
struct CellTypeInfo {
  CellType type;
  std::string_view name;  ///< as meshio writes it
  int nodes;              ///< nodes per cell
  int dimension;          ///< 3 for a volume, 2 for a sheet, 1 for a line
  int order;              ///< 1 straight edges, 2 a node in the middle of each edge
  int corners;            ///< nodes that are corners; they come first
};

/// The row of the table of cell types that belongs to `type`.
const CellTypeInfo& info(CellType type);

/// Every row of the table that is a volume, in the order of the enumeration.
std::span<const CellTypeInfo> cell_types();

/// The type of volume with that name; nothing when there is none.
std::optional<CellType> cell_type(std::string_view name);

/// The type of sheet or line with that name; nothing when there is none.
std::optional<CellType> thin_cell_type(std::string_view name);

/// Cells of one type: their node numbers one cell after the other.
struct CellBlock {
  CellType type = CellType::tetra;
  std::vector<std::int32_t> nodes;

  /// Number of cells.
  std::int32_t size() const;
  /// The node numbers of cell `i` of this block.
  std::span<const std::int32_t> cell(std::int32_t i) const;
};

/// Nodes and cells. Cells are numbered across the blocks, first block first.
struct Mesh {
  std::vector<double> positions;  ///< 3 numbers per node [m]
  std::vector<CellBlock> blocks;

  std::int32_t node_count() const;
  std::int32_t cell_count() const;
  /// Position of node `i` [m].
  Vec3 node(std::int32_t i) const;
};

}  // namespace tissu
