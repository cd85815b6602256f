#pragma once

/// Cells put together in patches that share one volume ratio: which cells, and where they stand in the lanes
/// of the kernels.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/cell/element_order.h"

namespace tissu {

/// Nodes that a patch has at most.
inline constexpr int kMostPatchNodes = 40;

/// The patch of each cell, numbered from 0 without gaps. A hexahedron is a patch. Cells of the other types
/// are put together around nodes: the node with most free cells takes them, as long as it has enough; what is
/// left joins the smallest patch across a face. Cells of a patch hang together by faces, and have one number
/// in `kinds` where that is not empty. The same cells in the same order give the same patches.
std::vector<std::int32_t> group_cells(std::string_view element, std::span<const std::int32_t> cells, int size,
                                      std::span<const std::int32_t> kinds = {});

/// Patches in the order and the lanes of the kernels.
struct PatchTable {
  std::vector<std::int32_t> first_patch;  ///< [group + 1]; see MeanDilatationView
  std::vector<std::int32_t> first_lane;   ///< [patch + 1]
  std::vector<std::int32_t> lanes;        ///< patch after patch
  AlignedVector<double> inverse_volumes;  ///< [group][8]
  std::vector<std::int32_t> first_node;   ///< [patch + 1]
  std::vector<std::int32_t> nodes;        ///< of the world, patch after patch, ascending in each
  std::vector<std::uint8_t> places;       ///< [as lanes][node]: its number in the patch
  std::vector<std::int64_t> first_slot;   ///< [patch + 1]
  std::vector<std::int32_t> slots;        ///< [row][column] of each patch, blocks of the matrix

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(first_lane.size()) - 1; }
  [[nodiscard]] std::size_t bytes() const;
};

/// `order` has the cells of a patch in one chunk; `volumes` are those of the cells at rest [m3].
PatchTable patch_table(std::span<const std::int32_t> of_cell, std::span<const std::int32_t> cells, int size,
                       const ElementOrder& order, const std::vector<double>& volumes);

}  // namespace tissu
