#include "tissu/model/edges/tensor_table.h"

#include <algorithm>
#include <limits>

namespace tissu {
namespace {

constexpr std::size_t kLanes = ElementOrder::kLanes;
constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

/// The nodes of a node, edge, face or tetrahedron, ascending; kNone fills up.
using Key = std::array<std::int32_t, 4>;

/// One of them, and a cell that has it.
struct CellPart {
  Key key;
  std::int32_t cell;
  auto operator<=>(const CellPart&) const = default;
};

/// The parts of a cell: every choice of `size` of its nodes.
template <class Function>
void for_parts(const std::int32_t* cell, int size, Function&& f) {
  for (unsigned chosen = 1; chosen < 16; ++chosen) {
    if (__builtin_popcount(chosen) != size) continue;
    Key key = {kNone, kNone, kNone, kNone};
    std::size_t n = 0;
    for (unsigned a = 0; a < 4; ++a) {
      if ((chosen >> a & 1U) != 0) key[n++] = cell[a];
    }
    std::ranges::sort(key);
    f(key);
  }
}

/// The parts of all cells that `wanted` takes, ascending, and those of one key in the order of their cells.
template <class Predicate>
std::vector<CellPart> parts_of(TensorCells cells, int size, Predicate&& wanted) {
  std::vector<CellPart> parts;
  for (std::size_t e = 0; e < cells.size() / 4; ++e) {
    for_parts(&cells[4 * e], size, [&](const Key& key) {
      if (wanted(key)) parts.push_back({key, static_cast<std::int32_t>(e)});
    });
  }
  std::ranges::sort(parts);
  return parts;
}

/// Adds what a cell gives to one of its parts.
void add_part(const TensorCell& cell, const std::int32_t* nodes, const Key& key, const TensorTable& table,
              double* to) {
  std::array<std::size_t, 4> at = {};
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.size); ++i) {
    at[i] = static_cast<std::size_t>(std::find(nodes, nodes + 4, key[i]) - nodes);
  }
  add_tensor_constants(cell, at, table.size, table.reals == 9, to);
}

/// Sums up what cells give to one key, the parts from `first` on that have it. Returns the next.
std::size_t sum_up(const std::vector<CellPart>& parts, std::size_t first, TensorCells cells,
                   const TensorCellOf& cell_of, const TensorTable& table, double* to) {
  const Key key = parts[first].key;
  std::fill_n(to, table.reals, 0.0);
  for (; first < parts.size() && parts[first].key == key; ++first) {
    const std::int32_t cell = parts[first].cell;
    add_part(cell_of(cell), &cells[4 * static_cast<std::size_t>(cell)], key, table, to);
  }
  return first;
}

/// The place of the first constant of a lane; the others follow kLanes apart.
double* constants_of(TensorTable& table, std::size_t lane) {
  return table.constants.data() + lane / kLanes * static_cast<std::size_t>(table.reals) * kLanes +
         lane % kLanes;
}
void write_lane(TensorTable& table, std::size_t lane, const double* from) {
  double* to = constants_of(table, lane);
  for (int r = 0; r < table.reals; ++r)
    to[static_cast<std::size_t>(r) * kLanes] = from == nullptr ? 0.0 : from[r];
}

TensorTable copy_of(const TensorTable& table) {
  TensorTable copy;
  copy.size = table.size;
  copy.reals = table.reals;
  copy.nodes = table.nodes;
  copy.constants = table.constants;
  copy.order.element = table.order.element;
  copy.order.real = table.order.real;
  copy.order.chunks = table.order.chunks;
  copy.order.colour_begin = table.order.colour_begin;
  copy.order.nodes = table.order.nodes;
  copy.order.places = table.order.places;
  for (Chunk& chunk : copy.order.chunks) {
    chunk.nodes = copy.order.nodes.data() + (chunk.nodes - table.order.nodes.data());
  }
  return copy;
}

/// The lane of each node, edge, … of a table that is still there.
std::vector<std::size_t> lanes_of(const TensorTable& table) {
  std::vector<std::size_t> lanes(table.nodes.size() / static_cast<std::size_t>(table.size));
  for (std::size_t i = 0; i < table.order.element.size(); ++i) {
    if (table.order.real[i] != 0) lanes[static_cast<std::size_t>(table.order.element[i])] = i;
  }
  return lanes;
}

/// The number in a table of a key that it has.
std::size_t number_of(const TensorTable& table, const Key& key) {
  const auto size = static_cast<std::ptrdiff_t>(table.size);
  const auto node = table.nodes.begin();
  std::ptrdiff_t low = 0;
  std::ptrdiff_t high = static_cast<std::ptrdiff_t>(table.nodes.size()) / size;
  while (high - low > 1) {
    const std::ptrdiff_t middle = (low + high) / 2;
    const bool above = std::lexicographical_compare(key.begin(), key.begin() + size, node + middle * size,
                                                    node + (middle + 1) * size);
    (above ? high : low) = middle;
  }
  return static_cast<std::size_t>(low);
}

/// Lanes that have what is no longer there only pad from now on: they repeat another of their chunk, without
/// constants. A chunk that has nothing left is empty.
void bury(TensorTable& table, std::size_t lane) {
  ElementOrder& order = table.order;
  const std::int32_t gone = order.element[lane];
  const auto group = static_cast<std::int32_t>(lane / kLanes);
  Chunk& chunk =
      *std::ranges::find_if(order.chunks, [&](const Chunk& c) { return c.begin <= group && group < c.end; });
  const auto begin = static_cast<std::size_t>(chunk.begin) * kLanes;
  const auto end = static_cast<std::size_t>(chunk.end) * kLanes;
  order.real[lane] = 0;
  write_lane(table, lane, nullptr);
  std::size_t other = begin;
  while (other < end && order.real[other] == 0) ++other;
  if (other == end) {
    chunk.end = chunk.begin;
    return;
  }
  const auto size = static_cast<std::size_t>(table.size);
  for (std::size_t i = begin; i < end; ++i) {
    if (order.element[i] != gone) continue;
    order.element[i] = order.element[other];
    for (std::size_t a = 0; a < size; ++a) {
      order.places[(i / kLanes * size + a) * kLanes + i % kLanes] =
          order.places[(other / kLanes * size + a) * kLanes + other % kLanes];
    }
  }
}

/// The parts of some cells, each once, and their nodes.
struct Touched {
  Touched(TensorCells cells, int size, std::size_t nodes) : has_node(nodes, 0) {
    for (const std::int32_t node : cells) has_node[static_cast<std::size_t>(node)] = 1;
    for (const CellPart& part : parts_of(cells, size, [](const Key&) { return true; })) {
      if (keys.empty() || keys.back() != part.key) keys.push_back(part.key);
    }
  }
  [[nodiscard]] bool operator()(const Key& key) const {
    const bool near = std::ranges::all_of(key, [&](std::int32_t node) {
      return node == kNone || has_node[static_cast<std::size_t>(node)] != 0;
    });
    return near && std::ranges::binary_search(keys, key);
  }
  std::vector<Key> keys;
  std::vector<char> has_node;
};

}  // namespace

std::size_t TensorTable::bytes() const {
  return constants.size() * sizeof(double) + order.places.size() * sizeof(std::uint16_t) +
         (nodes.size() + order.nodes.size() + slots.size()) * sizeof(std::int32_t);
}

std::size_t TensorTable::held() const {
  return static_cast<std::size_t>(std::ranges::count(order.real, 1)) * static_cast<std::size_t>(reals);
}

TensorTable tensor_table(int size, int reals, TensorCells cells, const TensorCellOf& cell_of, ConstReals X) {
  const std::vector<CellPart> parts = parts_of(cells, size, [](const Key&) { return true; });
  TensorTable table;
  table.size = size;
  table.reals = reals;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && parts[i].key == parts[i - 1].key) continue;
    table.nodes.insert(table.nodes.end(), parts[i].key.begin(), parts[i].key.begin() + size);
  }
  table.order = order_elements(table.nodes, size, X);
  table.constants.assign(table.order.element.size() * static_cast<std::size_t>(reals), 0.0);
  const std::vector<std::size_t> lanes = lanes_of(table);
  std::vector<double> sum(static_cast<std::size_t>(reals));
  std::size_t next = 0;
  for (const std::size_t lane : lanes) {
    next = sum_up(parts, next, cells, cell_of, table, sum.data());
    write_lane(table, lane, sum.data());
  }
  table.computed = table.held();
  return table;
}

TensorTable without(const TensorTable& before, TensorCells removed, TensorCells cells,
                    const TensorCellOf& cell_of, std::size_t nodes) {
  TensorTable table = copy_of(before);
  const Touched touched(removed, table.size, nodes);
  const std::vector<CellPart> parts = parts_of(cells, table.size, touched);
  const std::vector<std::size_t> lanes = lanes_of(table);
  std::vector<double> sum(static_cast<std::size_t>(table.reals));
  std::size_t next = 0;
  for (const Key& key : touched.keys) {
    const std::size_t lane = lanes[number_of(table, key)];
    if (next < parts.size() && parts[next].key == key) {
      next = sum_up(parts, next, cells, cell_of, table, sum.data());
      write_lane(table, lane, sum.data());
      table.computed += sum.size();
    } else {
      bury(table, lane);
    }
  }
  return table;
}

}  // namespace tissu
