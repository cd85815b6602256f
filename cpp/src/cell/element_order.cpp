#include "tissu/cell/element_order.h"

#include <algorithm>
#include <bit>
#include <numeric>

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

/// Lanes of a group take elements far apart in their chunk, so that they seldom share a node and the sums of
/// one lane do not wait for those of the lane before.
void lay_chunk(std::span<const std::int32_t> elements, ElementOrder& order) {
  const auto count = static_cast<std::int32_t>(elements.size());
  const std::int32_t groups = (count + ElementOrder::kLanes - 1) / ElementOrder::kLanes;
  const std::int32_t first = order.groups();
  for (std::int32_t g = 0; g < groups; ++g) {
    for (std::int32_t lane = 0; lane < ElementOrder::kLanes; ++lane) {
      const std::int32_t i = lane * groups + g;
      order.element.push_back(elements[static_cast<std::size_t>(std::min(i, count - 1))]);
      order.real.push_back(i < count ? 1 : 0);
    }
  }
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

/// Lists the nodes of each chunk, and gives each element its nodes' places among them.
void pack_nodes(std::span<const std::int32_t> cells, int size, ElementOrder& order) {
  std::vector<std::size_t> first;
  order.places.resize(order.element.size() * static_cast<std::size_t>(size));
  for (Chunk& chunk : order.chunks) {
    const auto begin = static_cast<std::size_t>(chunk.begin) * ElementOrder::kLanes;
    const auto end = static_cast<std::size_t>(chunk.end) * ElementOrder::kLanes;
    std::vector<std::int32_t> nodes;
    for (std::size_t i = begin; i < end; ++i) {
      const auto cell =
          cells.subspan(static_cast<std::size_t>(order.element[i] * size), static_cast<std::size_t>(size));
      nodes.insert(nodes.end(), cell.begin(), cell.end());
    }
    std::ranges::sort(nodes);
    nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t a = 0; a < static_cast<std::size_t>(size); ++a) {
        const std::int32_t node = cells[static_cast<std::size_t>(order.element[i] * size) + a];
        const auto place = std::ranges::lower_bound(nodes, node) - nodes.begin();
        const std::size_t group = i / ElementOrder::kLanes;
        order.places[(group * static_cast<std::size_t>(size) + a) * ElementOrder::kLanes +
                     i % ElementOrder::kLanes] = static_cast<std::uint16_t>(4 * place);
      }
    }
    first.push_back(order.nodes.size());
    chunk.node_count = static_cast<std::int32_t>(nodes.size());
    order.nodes.insert(order.nodes.end(), nodes.begin(), nodes.end());
  }
  for (std::size_t c = 0; c < first.size(); ++c) order.chunks[c].nodes = order.nodes.data() + first[c];
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

}  // namespace tissu
