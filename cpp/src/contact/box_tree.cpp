#include "contact/box_tree.h"

#include <algorithm>
#include <limits>

namespace tissu {
namespace {

constexpr std::size_t kSlices = 16;
constexpr std::int32_t kByCost = 48;  ///< depth down to which cost says where to cut
constexpr double kWorn = 1.6;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Half the area; in double precision, where no box of single precision overflows.
double area(const Box& box) {
  const double x = static_cast<double>(box.high[0]) - static_cast<double>(box.low[0]);
  const double y = static_cast<double>(box.high[1]) - static_cast<double>(box.low[1]);
  const double z = static_cast<double>(box.high[2]) - static_cast<double>(box.low[2]);
  return x * y + y * z + z * x;
}

constexpr Box kNone{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

/// As Box::add, of boxes that are known to hold numbers.
void unite(Box& box, const Box& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
}

float middle(const Box& box, std::size_t axis) { return 0.5F * box.low[axis] + 0.5F * box.high[axis]; }

/// Along which axis a part is cut into slices, and which slice a box is in.
struct Slices {
  std::size_t axis = 0;
  double low = 0.0;
  double scale = 0.0;  ///< 0: all middles are in one place

  explicit Slices(const Box& middles) {
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = static_cast<double>(middles.high[k]) - static_cast<double>(middles.low[k]);
      if (length > longest) {
        longest = length;
        axis = k;
      }
    }
    low = static_cast<double>(middles.low[axis]);
    if (longest > 0.0) scale = static_cast<double>(kSlices) / longest;
  }
  [[nodiscard]] std::size_t of(const Box& box) const {
    const double at = (static_cast<double>(middle(box, axis)) - low) * scale;
    return std::min(static_cast<std::size_t>(at), kSlices - 1);
  }
};

/// How many boxes are in each slice, and what holds them.
struct Counts {
  std::array<Box, kSlices> box;
  std::array<std::int32_t, kSlices> count{};
  Counts() { box.fill(kNone); }

  /// The number of slices on the left side of the cheapest cut; 0 where none has boxes on both sides or all
  /// areas are zero.
  [[nodiscard]] std::size_t cheapest() const {
    std::array<double, kSlices> right{};  // cost of the slices from one on
    Box held = kNone;
    std::int32_t n = 0;
    for (std::size_t s = kSlices - 1; s > 0; --s) {
      unite(held, box[s]);
      n += count[s];
      right[s] = n > 0 ? area(held) * n : -1.0;
    }
    held = kNone;
    n = 0;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 1; s < kSlices; ++s) {
      unite(held, box[s - 1]);
      n += count[s - 1];
      if (n == 0 || right[s] < 0.0) continue;
      const double cost = area(held) * n + right[s];
      if (cost >= least) continue;
      least = cost;
      best = s;
    }
    return least > 0.0 ? best : 0;
  }
};

}  // namespace

void BoxTree::reserve(std::size_t primitives) {
  entries_.reserve(primitives);
  nodes_.reserve(2 * primitives);
  leaves_.reserve(primitives);
}

void BoxTree::build(std::span<const Box> boxes, std::span<const std::int32_t> primitives) {
  entries_.clear();
  nodes_.clear();
  leaves_.clear();
  reserve(primitives.size());  // a tree built again, with other leaves, takes no memory
  for (const std::int32_t p : primitives) entries_.push_back({boxes[static_cast<std::size_t>(p)], p});
  if (entries_.empty()) return;
  std::array<Part, kDeepest + 1> waiting;
  std::size_t count = 0;
  nodes_.emplace_back();
  waiting[count++] = {0, 0, static_cast<std::int32_t>(entries_.size()), 0};
  while (count > 0) {
    const Part part = waiting[--count];
    if (part.count <= kLeaf) {
      make_leaf(part);
      continue;
    }
    const std::int32_t left = cut(part);
    const auto child = static_cast<std::int32_t>(nodes_.size());
    nodes_[static_cast<std::size_t>(part.node)] = {kNone, child, 0};
    nodes_.resize(nodes_.size() + 2);
    waiting[count++] = {child + 1, part.first + left, part.count - left, part.depth + 1};
    waiting[count++] = {child, part.first, left, part.depth + 1};
  }
  built_ = follow(boxes);
}

void BoxTree::make_leaf(const Part& part) {
  Leaf leaf;
  for (std::size_t k = 0; k < 3; ++k) {
    leaf.low[k].fill(kInfinity);
    leaf.high[k].fill(-kInfinity);
  }
  leaf.primitive.fill(-1);
  for (std::int32_t i = 0; i < part.count; ++i) {
    leaf.primitive[static_cast<std::size_t>(i)] =
        entries_[static_cast<std::size_t>(part.first + i)].primitive;
  }
  nodes_[static_cast<std::size_t>(part.node)] = {kNone, static_cast<std::int32_t>(leaves_.size()),
                                                 part.count};
  leaves_.push_back(leaf);
}

/// Puts the entries of a part in two groups; how many are in the first one.
std::int32_t BoxTree::cut(const Part& part) {
  const auto begin = entries_.begin() + part.first;
  const auto end = begin + part.count;
  Box middles = kNone;
  for (auto at = begin; at != end; ++at) {
    const std::array<float, 3> m{middle(at->box, 0), middle(at->box, 1), middle(at->box, 2)};
    unite(middles, {m, m});
  }
  if (part.depth >= kByCost) return halve(part, middles);
  const Slices slices(middles);
  Counts counts;
  for (auto at = begin; at != end; ++at) {
    const std::size_t slice = slices.of(at->box);
    unite(counts.box[slice], at->box);
    ++counts.count[slice];
  }
  const std::size_t left = counts.cheapest();
  if (left == 0) return halve(part, middles);
  const auto second = std::partition(begin, end, [&](const Entry& e) { return slices.of(e.box) < left; });
  return static_cast<std::int32_t>(second - begin);
}

/// As many on either side. The order of middles that are equal is that of the numbers.
std::int32_t BoxTree::halve(const Part& part, const Box& middles) {
  const auto begin = entries_.begin() + part.first;
  const std::size_t axis = Slices(middles).axis;
  const std::int32_t half = part.count / 2;
  std::nth_element(begin, begin + half, begin + part.count, [axis](const Entry& a, const Entry& b) {
    const float x = middle(a.box, axis);
    const float y = middle(b.box, axis);
    return x < y || (x == y && a.primitive < b.primitive);
  });
  return half;
}

bool BoxTree::refit(std::span<const Box> boxes) {
  if (nodes_.empty()) return false;
  const Areas now = follow(boxes);
  const auto base = [](const Areas& areas) { return areas.primitives > 0.0 ? areas.primitives : 1.0; };
  return now.nodes / base(now) > kWorn * (built_.nodes / base(built_));
}

/// From the last node to the root, so that children come before their parents.
BoxTree::Areas BoxTree::follow(std::span<const Box> boxes) {
  Areas areas;
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    if (node.count == 0) {
      node.box = nodes_[static_cast<std::size_t>(node.first)].box;
      unite(node.box, nodes_[static_cast<std::size_t>(node.first) + 1].box);
      areas.nodes += area(node.box);
      continue;
    }
    Leaf& leaf = leaves_[static_cast<std::size_t>(node.first)];
    node.box = kNone;
    for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i) {
      const Box& box = boxes[static_cast<std::size_t>(leaf.primitive[i])];
      for (std::size_t k = 0; k < 3; ++k) {
        leaf.low[k][i] = box.low[k];
        leaf.high[k][i] = box.high[k];
      }
      unite(node.box, box);
      areas.primitives += area(box);
    }
    areas.nodes += area(node.box) * node.count;
  }
  return areas;
}

std::size_t BoxTree::bytes() const {
  return nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(Leaf) +
         entries_.capacity() * sizeof(Entry);
}

}  // namespace tissu
