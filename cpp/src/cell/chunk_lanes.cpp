#include "chunk_lanes.h"

#include <algorithm>
#include <numeric>

#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

constexpr std::size_t kLanes = ElementOrder::kLanes;

}  // namespace

void lay_lanes(std::span<const std::int32_t> elements, std::int32_t first, ElementOrder& order) {
  const auto count = static_cast<std::int32_t>(elements.size());
  const std::int32_t groups = groups_for(elements.size());
  for (std::int32_t g = 0; g < groups; ++g) {
    for (std::int32_t lane = 0; lane < ElementOrder::kLanes; ++lane) {
      const std::int32_t i = lane * groups + g;
      const auto to = static_cast<std::size_t>((first + g) * ElementOrder::kLanes + lane);
      order.element[to] = elements[static_cast<std::size_t>(std::min(i, count - 1))];
      order.real[to] = i < count ? 1 : 0;
    }
  }
}

std::vector<std::int32_t> lay_places(std::span<const std::int32_t> cells, int size, std::int32_t begin,
                                     std::int32_t end, ElementOrder& order) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<std::int32_t> nodes;
  const auto first = static_cast<std::size_t>(begin) * kLanes;
  const auto last = static_cast<std::size_t>(end) * kLanes;
  for (std::size_t i = first; i < last; ++i) {
    const auto cell = cells.subspan(static_cast<std::size_t>(order.element[i]) * n, n);
    nodes.insert(nodes.end(), cell.begin(), cell.end());
  }
  sort_unique(nodes);
  for (std::size_t i = first; i < last; ++i) {
    for (std::size_t a = 0; a < n; ++a) {
      const std::int32_t node = cells[static_cast<std::size_t>(order.element[i]) * n + a];
      const auto place = std::ranges::lower_bound(nodes, node) - nodes.begin();
      order.places[(i / kLanes * n + a) * kLanes + i % kLanes] = static_cast<std::uint16_t>(4 * place);
    }
  }
  return nodes;
}

void sort_by_colour(const std::vector<std::int32_t>& colour, ElementOrder& order) {
  std::vector<std::size_t> index(colour.size());
  std::iota(index.begin(), index.end(), std::size_t{0});
  std::ranges::stable_sort(index, {}, [&](std::size_t c) { return colour[c]; });
  std::vector<Chunk> chunks;
  order.colour_begin.assign(1, 0);
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (i > 0 && colour[index[i]] != colour[index[i - 1]])
      order.colour_begin.push_back(static_cast<std::int32_t>(i));
    chunks.push_back(order.chunks[index[i]]);
  }
  order.colour_begin.push_back(static_cast<std::int32_t>(chunks.size()));
  order.chunks = std::move(chunks);
}

void pack_nodes(std::span<const std::int32_t> cells, int size, ElementOrder& order) {
  std::vector<std::size_t> first;
  order.places.resize(order.element.size() * static_cast<std::size_t>(size));
  for (Chunk& chunk : order.chunks) {
    const std::vector<std::int32_t> nodes = lay_places(cells, size, chunk.begin, chunk.end, order);
    first.push_back(order.nodes.size());
    chunk.node_count = static_cast<std::int32_t>(nodes.size());
    order.nodes.insert(order.nodes.end(), nodes.begin(), nodes.end());
  }
  for (std::size_t c = 0; c < first.size(); ++c) order.chunks[c].nodes = order.nodes.data() + first[c];
}

}  // namespace tissu
