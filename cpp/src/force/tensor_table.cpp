#include "tissu/force/tensor_table.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tissu {
namespace {

constexpr std::size_t kLanes = ElementOrder::kLanes;
constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

/// The nodes of a node, edge, face or tetrahedron, ascending; kNone fills up.
using Key = std::array<std::int32_t, 4>;

/// One of them, and a cell that has it.
struct Part {
  Key key;
  std::int32_t cell;
  auto operator<=>(const Part&) const = default;
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
std::vector<Part> parts_of(TensorCells cells, int size, Predicate&& wanted) {
  std::vector<Part> parts;
  for (std::size_t e = 0; e < cells.size() / 4; ++e) {
    for_parts(&cells[4 * e], size, [&](const Key& key) {
      if (wanted(key)) parts.push_back({key, static_cast<std::int32_t>(e)});
    });
  }
  std::ranges::sort(parts);
  return parts;
}

/// B, C and D of one tetrahedron.
struct Formulae {
  const TensorCell& of;

  [[nodiscard]] double dot(std::size_t a, std::size_t b) const { return of.g[a].dot(of.g[b]); }
  void add_B(std::size_t a, std::size_t b, double*& to) const {
    const Mat3 B =
        of.volume * (of.lame.lambda * of.g[a] * of.g[b].transpose() +
                     of.lame.mu * of.g[b] * of.g[a].transpose() + of.lame.mu * dot(a, b) * Mat3::Identity());
    for (int k = 0; k < 9; ++k) *to++ += B(k / 3, k % 3);
  }
  void add_C(double times, std::size_t a, std::size_t b, std::size_t c, double*& to) const {
    const Vec3 C = of.volume * (of.lame.lambda / 2.0 * of.g[a] * dot(b, c) +
                                of.lame.mu / 2.0 * (of.g[c] * dot(a, b) + of.g[b] * dot(a, c)));
    for (int k = 0; k < 3; ++k) *to++ += times * C[k];
  }
  void add_D(double times, std::size_t a, std::size_t b, std::size_t c, std::size_t d, double*& to) const {
    *to++ += times * of.volume *
             (of.lame.lambda / 8.0 * dot(a, b) * dot(c, d) + of.lame.mu / 4.0 * dot(a, d) * dot(b, c));
  }
};

using Local = std::array<std::size_t, 4>;

void add_node(const Formulae& of, const Local& at, double* to) {
  const auto p = at[0];
  of.add_C(1.0, p, p, p, to);
  of.add_D(2.0, p, p, p, p, to);
}

void add_edge(const Formulae& of, const Local& at, double* to) {
  const auto [p, j, unused, neither] = at;
  of.add_C(2.0, p, p, j, to);
  of.add_C(1.0, j, p, p, to);
  of.add_C(2.0, j, j, p, to);
  of.add_C(1.0, p, j, j, to);
  of.add_D(4.0, j, p, p, p, to);
  of.add_D(4.0, j, j, j, p, to);
  of.add_D(2.0, j, j, p, p, to);
  of.add_D(4.0, j, p, j, p, to);
  of.add_D(4.0, p, j, j, p, to);
}

void add_face(const Formulae& of, const Local& at, double* to) {
  const auto each = [&](auto&& f) {
    for (std::size_t i = 0; i < 3; ++i) f(at[i], at[(i + 1) % 3], at[(i + 2) % 3]);
  };
  each([&](auto a, auto b, auto c) { of.add_C(2.0, a, b, c, to); });
  each([&](auto a, auto b, auto c) { of.add_D(4.0, a, a, b, c, to); });
  each([&](auto a, auto b, auto c) {
    of.add_D(4.0, a, b, a, c, to);
    of.add_D(4.0, b, a, a, c, to);
  });
}

void add_tetra(const Formulae& of, const Local& at, double* to) {
  const auto [a, b, c, d] = at;
  // Beside (u_a . u_b) (u_c . u_d) stand D^abcd and D^bacd; likewise for the two other ways to pair four
  // nodes.
  of.add_D(4.0, a, b, c, d, to);
  of.add_D(4.0, b, a, c, d, to);
  of.add_D(4.0, a, c, b, d, to);
  of.add_D(4.0, c, a, b, d, to);
  of.add_D(4.0, a, d, b, c, to);
  of.add_D(4.0, d, a, b, c, to);
}

/// Adds what a cell gives to one of its parts.
void add_constants(const TensorCell& cell, const std::int32_t* nodes, const Key& key, int size, int reals,
                   double* to) {
  Local at = {};
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    at[i] = static_cast<std::size_t>(std::find(nodes, nodes + 4, key[i]) - nodes);
  }
  const Formulae of{cell};
  if (size <= 2) of.add_B(at[0], at[size == 1 ? 0 : 1], to);
  if (size <= 2 && reals == 9) return;
  if (size == 1) add_node(of, at, to);
  if (size == 2) add_edge(of, at, to);
  if (size == 3) add_face(of, at, to);
  if (size == 4) add_tetra(of, at, to);
}

/// A table while it grows: keys ascending, their constants side by side.
class Growing {
 public:
  Growing(int size, int reals) : size_(size), reals_(reals) {}

  double* append(const Key& key) {
    nodes_.insert(nodes_.end(), key.begin(), key.begin() + size_);
    values_.resize(values_.size() + static_cast<std::size_t>(reals_), 0.0);
    return values_.data() + values_.size() - reals_;
  }
  /// Sums up what the cells give to one key: the parts from `first` on that have it. Returns the next.
  std::size_t append_sum(const std::vector<Part>& parts, std::size_t first, TensorCells cells,
                         const TensorCellOf& cell_of) {
    const Key key = parts[first].key;
    double* to = append(key);
    for (; first < parts.size() && parts[first].key == key; ++first) {
      const std::int32_t cell = parts[first].cell;
      add_constants(cell_of(cell), &cells[4 * static_cast<std::size_t>(cell)], key, size_, reals_, to);
    }
    computed_ += static_cast<std::size_t>(reals_);
    return first;
  }

  TensorTable lay(ConstReals X) {
    TensorTable table;
    table.size = size_;
    table.reals = reals_;
    table.computed = computed_;
    table.nodes = std::move(nodes_);
    if (table.nodes.empty()) return table;
    table.order = order_elements(table.nodes, size_, X);
    const auto reals = static_cast<std::size_t>(reals_);
    table.constants.assign(table.order.element.size() * reals, 0.0);
    for (std::size_t i = 0; i < table.order.element.size(); ++i) {
      if (table.order.real[i] == 0) continue;
      const double* from = &values_[static_cast<std::size_t>(table.order.element[i]) * reals];
      double* to = &table.constants[i / kLanes * reals * kLanes + i % kLanes];
      for (std::size_t r = 0; r < reals; ++r) to[r * kLanes] = from[r];
    }
    return table;
  }

 private:
  int size_;
  int reals_;
  std::vector<std::int32_t> nodes_;
  std::vector<double> values_;
  std::size_t computed_ = 0;
};

/// The lane of each part of a table.
std::vector<std::size_t> lanes_of(const TensorTable& table) {
  std::vector<std::size_t> lanes(table.nodes.size() / static_cast<std::size_t>(table.size));
  for (std::size_t i = 0; i < table.order.element.size(); ++i) {
    if (table.order.real[i] != 0) lanes[static_cast<std::size_t>(table.order.element[i])] = i;
  }
  return lanes;
}

}  // namespace

std::size_t TensorTable::bytes() const {
  return constants.size() * sizeof(double) + order.places.size() * sizeof(std::uint16_t) +
         (nodes.size() + order.nodes.size() + slots.size()) * sizeof(std::int32_t);
}

TensorTable tensor_table(int size, int reals, TensorCells cells, const TensorCellOf& cell_of, ConstReals X) {
  const std::vector<Part> parts = parts_of(cells, size, [](const Key&) { return true; });
  Growing growing(size, reals);
  for (std::size_t i = 0; i < parts.size();) i = growing.append_sum(parts, i, cells, cell_of);
  return growing.lay(X);
}

TensorTable without(const TensorTable& before, TensorCells removed, TensorCells cells,
                    const TensorCellOf& cell_of, ConstReals X) {
  std::vector<Key> touched;
  std::vector<char> at(X.size() / 3, 0);  // nodes of removed cells
  for (const Part& part : parts_of(removed, before.size, [](const Key&) { return true; })) {
    if (touched.empty() || touched.back() != part.key) touched.push_back(part.key);
    for (const std::int32_t node : part.key) {
      if (node != kNone) at[static_cast<std::size_t>(node)] = 1;
    }
  }
  const auto is_touched = [&](const Key& key) {
    const bool near = std::ranges::all_of(
        key, [&](std::int32_t node) { return node == kNone || at[static_cast<std::size_t>(node)] != 0; });
    return near && std::ranges::binary_search(touched, key);
  };
  const std::vector<Part> parts = parts_of(cells, before.size, is_touched);
  const std::vector<std::size_t> lanes = lanes_of(before);
  const auto reals = static_cast<std::size_t>(before.reals);
  const auto size = static_cast<std::size_t>(before.size);
  Growing growing(before.size, before.reals);
  std::size_t next = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    Key key = {kNone, kNone, kNone, kNone};
    std::copy_n(&before.nodes[i * size], size, key.begin());
    if (next < parts.size() && parts[next].key == key) {
      next = growing.append_sum(parts, next, cells, cell_of);
    } else if (!is_touched(key)) {
      double* to = growing.append(key);
      const double* from = &before.constants[lanes[i] / kLanes * reals * kLanes + lanes[i] % kLanes];
      for (std::size_t r = 0; r < reals; ++r) to[r] = from[r * kLanes];
    }
  }
  return growing.lay(X);
}

}  // namespace tissu
