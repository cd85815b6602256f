#include <algorithm>

#include "tissu/base/sort_unique.h"
#include "tissu/cell/cell_patches.h"

namespace tissu {
namespace {

/// Lanes of each patch, the patches in the order of the chunks' groups.
void lay_lanes(std::span<const std::int32_t> of_cell, const ElementOrder& order, PatchTable& table) {
  const auto groups = static_cast<std::size_t>(order.groups());
  table.first_patch.assign(groups + 1, 0);
  table.first_lane.assign(1, 0);
  std::vector<Chunk> chunks = order.chunks;
  std::ranges::sort(chunks, {}, &Chunk::begin);
  std::vector<std::pair<std::int32_t, std::int32_t>> found;  // patch and lane
  for (const Chunk& chunk : chunks) {
    found.clear();
    for (std::int32_t i = chunk.begin * ElementOrder::kLanes; i < chunk.end * ElementOrder::kLanes; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (order.real[at] != 0) found.emplace_back(of_cell[static_cast<std::size_t>(order.element[at])], i);
    }
    std::ranges::sort(found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      table.lanes.push_back(found[i].second);
      if (i + 1 == found.size() || found[i + 1].first != found[i].first) {
        table.first_lane.push_back(static_cast<std::int32_t>(table.lanes.size()));
      }
    }
    table.first_patch[static_cast<std::size_t>(chunk.end)] = table.count();
  }
}

void lay_nodes(std::span<const std::int32_t> cells, std::size_t size, const ElementOrder& order,
               PatchTable& table) {
  table.first_node.assign(1, 0);
  table.first_slot.assign(1, 0);
  std::vector<std::int32_t> nodes;
  for (std::size_t p = 0; p + 1 < table.first_lane.size(); ++p) {
    const std::span lanes(table.lanes.begin() + table.first_lane[p],
                          table.lanes.begin() + table.first_lane[p + 1]);
    const auto for_nodes = [&](auto&& f) {
      for (const std::int32_t lane : lanes) {
        const auto cell = static_cast<std::size_t>(order.element[static_cast<std::size_t>(lane)]);
        for (std::size_t a = 0; a < size; ++a) f(cells[cell * size + a]);
      }
    };
    nodes.clear();
    for_nodes([&](std::int32_t node) { nodes.push_back(node); });
    sort_unique(nodes);
    for_nodes([&](std::int32_t node) {
      table.places.push_back(
          static_cast<std::uint8_t>(std::ranges::lower_bound(nodes, node) - nodes.begin()));
    });
    table.nodes.insert(table.nodes.end(), nodes.begin(), nodes.end());
    table.first_node.push_back(static_cast<std::int32_t>(table.nodes.size()));
    const auto n = static_cast<std::int64_t>(nodes.size());
    table.first_slot.push_back(table.first_slot.back() + n * n);
  }
}

}  // namespace

PatchTable patch_table(std::span<const std::int32_t> of_cell, std::span<const std::int32_t> cells, int size,
                       const ElementOrder& order, const std::vector<double>& volumes) {
  PatchTable table;
  lay_lanes(of_cell, order, table);
  lay_nodes(cells, static_cast<std::size_t>(size), order, table);
  table.inverse_volumes.assign(order.element.size(), 0.0);
  for (std::size_t p = 0; p + 1 < table.first_lane.size(); ++p) {
    const std::span lanes(table.lanes.begin() + table.first_lane[p],
                          table.lanes.begin() + table.first_lane[p + 1]);
    double volume = 0.0;
    for (const std::int32_t lane : lanes) {
      volume += volumes[static_cast<std::size_t>(order.element[static_cast<std::size_t>(lane)])];
    }
    for (const std::int32_t lane : lanes)
      table.inverse_volumes[static_cast<std::size_t>(lane)] = 1.0 / volume;
  }
  return table;
}

std::size_t PatchTable::bytes() const {
  return (first_patch.size() + first_lane.size() + lanes.size() + first_node.size() + nodes.size() +
          slots.size()) *
             sizeof(std::int32_t) +
         inverse_volumes.size() * sizeof(double) + places.size() + first_slot.size() * sizeof(std::int64_t);
}

}  // namespace tissu
