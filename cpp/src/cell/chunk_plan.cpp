#include "tissu/cell/chunk_plan.h"

#include <algorithm>

namespace tissu {

ChunkPlan plan_of(const ElementOrder& order, std::span<const std::int32_t> numbers) {
  constexpr auto kLanes = static_cast<std::size_t>(ElementOrder::kLanes);
  ChunkPlan plan;
  const std::size_t count = numbers.empty() ? 0 : static_cast<std::size_t>(std::ranges::max(numbers)) + 1;
  plan.chunk.assign(count, -1);
  plan.place.assign(count, 0);
  std::vector<std::pair<Chunk, std::int32_t>> along;  // with its colour
  for (std::int32_t colour = 0; colour < order.colours(); ++colour) {
    const auto c = static_cast<std::size_t>(colour);
    for (std::int32_t k = order.colour_begin[c]; k < order.colour_begin[c + 1]; ++k)
      along.emplace_back(order.chunks[static_cast<std::size_t>(k)], colour);
  }
  std::ranges::sort(along, {}, [](const auto& entry) { return entry.first.begin; });
  for (const auto& [chunk, colour] : along) {
    const auto groups = static_cast<std::size_t>(chunk.end - chunk.begin);
    const std::size_t first = static_cast<std::size_t>(chunk.begin) * kLanes;
    for (std::size_t i = 0; i < groups * kLanes; ++i) {
      if (order.real[first + i] == 0) continue;
      const auto number =
          static_cast<std::size_t>(numbers[static_cast<std::size_t>(order.element[first + i])]);
      plan.chunk[number] = static_cast<std::int32_t>(plan.colour.size());
      plan.place[number] = static_cast<std::int32_t>(i % kLanes * groups + i / kLanes);
    }
    plan.colour.push_back(colour);
  }
  return plan;
}

std::int32_t chunk_parts(std::size_t cells, int size) {
  const auto most = static_cast<std::size_t>(ElementOrder::chunk_size(size));
  return static_cast<std::int32_t>((cells + most - 1) / most);
}

}  // namespace tissu
