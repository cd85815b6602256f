#include "tissu/mesh/mesh.h"

#include <algorithm>
#include <array>

namespace tissu {
namespace {

constexpr std::size_t kVolumes = 9;
constexpr std::array<CellTypeInfo, 16> kCellTypes{{
    {CellType::tetra, "tetra", 4, 3, 1, 4},
    {CellType::hexahedron, "hexahedron", 8, 3, 1, 8},
    {CellType::tetra10, "tetra10", 10, 3, 2, 4},
    {CellType::hexahedron20, "hexahedron20", 20, 3, 2, 8},
    {CellType::hexahedron27, "hexahedron27", 27, 3, 2, 8},
    {CellType::wedge, "wedge", 6, 3, 1, 6},
    {CellType::wedge15, "wedge15", 15, 3, 2, 6},
    {CellType::pyramid, "pyramid", 5, 3, 1, 5},
    {CellType::pyramid13, "pyramid13", 13, 3, 2, 5},
    {CellType::triangle, "triangle", 3, 2, 1, 3},
    {CellType::triangle6, "triangle6", 6, 2, 2, 3},
    {CellType::quad, "quad", 4, 2, 1, 4},
    {CellType::quad8, "quad8", 8, 2, 2, 4},
    {CellType::quad9, "quad9", 9, 2, 2, 4},
    {CellType::line, "line", 2, 1, 1, 2},
    {CellType::line3, "line3", 3, 1, 2, 2},
}};

std::optional<CellType> named(std::span<const CellTypeInfo> types, std::string_view name) {
  const auto row = std::ranges::find(types, name, &CellTypeInfo::name);
  if (row == types.end()) return std::nullopt;
  return row->type;
}

}  // namespace

const CellTypeInfo& info(CellType type) { return kCellTypes[static_cast<std::size_t>(type)]; }

std::span<const CellTypeInfo> cell_types() { return std::span(kCellTypes).first(kVolumes); }

std::optional<CellType> cell_type(std::string_view name) { return named(cell_types(), name); }

std::optional<CellType> thin_cell_type(std::string_view name) {
  return named(std::span(kCellTypes).subspan(kVolumes), name);
}

std::int32_t CellBlock::size() const { return static_cast<std::int32_t>(nodes.size()) / info(type).nodes; }

std::span<const std::int32_t> CellBlock::cell(std::int32_t i) const {
  const auto width = static_cast<std::size_t>(info(type).nodes);
  return std::span(nodes).subspan(static_cast<std::size_t>(i) * width, width);
}

std::int32_t Mesh::node_count() const { return static_cast<std::int32_t>(positions.size() / 3); }

std::int32_t Mesh::cell_count() const {
  std::int32_t count = 0;
  for (const CellBlock& block : blocks) count += block.size();
  return count;
}

Vec3 Mesh::node(std::int32_t i) const { return block(ConstReals(positions), i); }

}  // namespace tissu
