#include "tissu/cell/element_order.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

#include "chunk_lanes.h"
#include "tissu/cell/chunk_plan.h"

namespace tissu {
namespace {

/// Spreads the low 21 bits of a number so that two zeros follow each.
std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

/// Elements along the Morton curve through their centroids.
std::vector<std::int32_t> along_curve(std::span<const std::int32_t> cells, int size, ConstReals positions) {
  const auto count = static_cast<std::int32_t>(cells.size()) / size;
  std::vector<Vec3> centroid(static_cast<std::size_t>(count), Vec3::Zero());
  Vec3 low = Vec3::Constant(INFINITY);
  Vec3 high = Vec3::Constant(-INFINITY);
  for (std::int32_t e = 0; e < count; ++e) {
    Vec3& c = centroid[static_cast<std::size_t>(e)];
    for (int a = 0; a < size; ++a) c += block(positions, cells[static_cast<std::size_t>(e * size + a)]);
    c /= size;
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  const double extent = std::max((high - low).maxCoeff(), 1e-300);
  std::vector<std::uint64_t> key(static_cast<std::size_t>(count));
  for (std::size_t e = 0; e < key.size(); ++e) {
    const Vec3 unit = (centroid[e] - low) / extent * 2097151.0;
    for (int axis = 0; axis < 3; ++axis)
      key[e] |= spread_bits(static_cast<std::uint64_t>(unit[axis])) << axis;
  }
  std::vector<std::int32_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::int32_t e) { return key[static_cast<std::size_t>(e)]; });
  return order;
}

/// Puts elements of one number after the first of them.
void bring_together(std::span<const std::int32_t> together, std::vector<std::int32_t>& curve) {
  std::vector<std::int32_t> place(static_cast<std::size_t>(std::ranges::max(together)) + 1, -1);
  std::int32_t next = 0;
  for (const std::int32_t e : curve) {
    std::int32_t& at = place[static_cast<std::size_t>(together[static_cast<std::size_t>(e)])];
    if (at < 0) at = next++;
  }
  std::ranges::stable_sort(curve, {}, [&](std::int32_t e) {
    return place[static_cast<std::size_t>(together[static_cast<std::size_t>(e)])];
  });
}

/// The end of a chunk, not later than `end`, that no number reaches across.
std::size_t end_between(std::span<const std::int32_t> together, const std::vector<std::int32_t>& curve,
                        std::size_t begin, std::size_t end) {
  const auto number = [&](std::size_t i) { return together[static_cast<std::size_t>(curve[i])]; };
  std::size_t last = end;
  while (last > begin && last < curve.size() && number(last) == number(last - 1)) --last;
  return last > begin ? last : end;
}

void lay_chunk(std::span<const std::int32_t> elements, ElementOrder& order) {
  const std::int32_t first = order.groups();
  const std::int32_t groups = groups_for(elements.size());
  order.element.resize(order.element.size() + static_cast<std::size_t>(groups * ElementOrder::kLanes));
  order.real.resize(order.element.size());
  lay_lanes(elements, first, order);
  order.chunks.push_back({first, first + groups, nullptr, 0});
}

/// The lowest colour that no chunk with a common node has; 63 colours at most, then chunks stand alone.
std::vector<std::int32_t> colour_chunks(const ElementOrder& order, std::span<const std::int32_t> cells,
                                        int size, std::size_t nodes) {
  std::vector<std::uint64_t> taken(nodes, 0);
  std::vector<std::int32_t> colour;
  std::int32_t alone = 64;
  for (const Chunk& chunk : order.chunks) {
    const std::span<const std::int32_t> elements(order.element.data() + chunk.begin * ElementOrder::kLanes,
                                                 order.element.data() + chunk.end * ElementOrder::kLanes);
    std::uint64_t used = 0;
    const auto for_nodes = [&](auto&& f) {
      for (const std::int32_t e : elements) {
        for (int a = 0; a < size; ++a)
          f(taken[static_cast<std::size_t>(cells[static_cast<std::size_t>(e * size + a)])]);
      }
    };
    for_nodes([&](std::uint64_t mask) { used |= mask; });
    const int free = std::countr_one(used);
    if (free >= 64) {
      colour.push_back(alone++);
      continue;
    }
    for_nodes([&](std::uint64_t& mask) { mask |= std::uint64_t{1} << free; });
    colour.push_back(free);
  }
  return colour;
}

}  // namespace

ElementOrder order_elements(std::span<const std::int32_t> cells, int size, ConstReals positions,
                            std::span<const std::int32_t> together, double fill) {
  std::vector<std::int32_t> curve = along_curve(cells, size, positions);
  if (!together.empty()) bring_together(together, curve);
  ElementOrder order;
  const auto groups = static_cast<std::int32_t>(fill * ElementOrder::chunk_size(size) / ElementOrder::kLanes);
  const auto step = static_cast<std::size_t>(std::max(groups, 1) * ElementOrder::kLanes);
  for (std::size_t begin = 0, end = 0; begin < curve.size(); begin = end) {
    end = std::min(curve.size(), begin + step);
    if (!together.empty()) end = end_between(together, curve, begin, end);
    lay_chunk(std::span(curve).subspan(begin, end - begin), order);
  }
  sort_by_colour(colour_chunks(order, cells, size, positions.size() / 3), order);
  pack_nodes(cells, size, order);
  return order;
}

ElementOrder order_by(const ChunkPlan& plan, const PlannedCells& cells) {
  const auto origin = [&](std::int32_t e) {
    return static_cast<std::size_t>(cells.origins[static_cast<std::size_t>(e)]);
  };
  std::vector<std::int32_t> curve(cells.numbers.size());
  std::iota(curve.begin(), curve.end(), 0);
  std::ranges::sort(curve, {}, [&](std::int32_t e) {
    return std::tuple(plan.chunk[origin(e)], plan.place[origin(e)],
                      cells.numbers[static_cast<std::size_t>(e)]);
  });
  ElementOrder order;
  std::vector<std::int32_t> colour;
  std::int32_t alone = plan.colour.empty() ? 0 : std::ranges::max(plan.colour) + 1;
  for (std::size_t begin = 0, end = 0; begin < curve.size(); begin = end) {
    const std::int32_t chunk = plan.chunk[origin(curve[begin])];
    while (end < curve.size() && plan.chunk[origin(curve[end])] == chunk) ++end;
    const std::int32_t parts = chunk_parts(end - begin, cells.size);
    for (std::int32_t p = 0; p < parts; ++p) {
      const std::size_t first = first_of_part(end - begin, p, parts);
      lay_chunk(std::span(curve).subspan(begin + first, first_of_part(end - begin, p + 1, parts) - first),
                order);
      colour.push_back(p == 0 ? plan.colour[static_cast<std::size_t>(chunk)] : alone++);
    }
  }
  sort_by_colour(colour, order);
  pack_nodes(cells.nodes, cells.size, order);
  return order;
}

}  // namespace tissu
