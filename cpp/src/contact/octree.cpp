#include "contact/octree.h"

#include <algorithm>
#include <limits>

namespace tissu {
namespace {

constexpr std::int32_t kLeaf = 8;    ///< boxes of a cube that is not cut
constexpr int kDeepest = 10;         ///< cuts
constexpr double kFinest = 1024.0;   ///< smallest cubes along a side: 2^kDeepest
constexpr unsigned kDepthBits = 4;   ///< of a cube's number
constexpr std::size_t kChanged = 5;  ///< built again when one in so many boxes has left its cube

/// Two zero bits after each of the lowest ten.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16U) & 0x030000FFU;
  x = (x | x << 8U) & 0x0300F00FU;
  x = (x | x << 4U) & 0x030C30C3U;
  return (x | x << 2U) & 0x09249249U;
}

double side_of(const Box& box, std::size_t axis) {
  return static_cast<double>(box.high[axis]) - static_cast<double>(box.low[axis]);
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

Octree::Octree(const SearchPlan& plan) : meetings_(plan) {
  const std::size_t n = meetings_.searched().size();
  placed_.reserve(n);
  boxes_.resize(n);
  // Leaves hold a box at least, and what is cut holds nine, ten times one in the other: n + 10 n / 9.
  nodes_.reserve(2 * n + n / 4 + 1);
}

void Octree::find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) {
  meetings_.check(boxes);
  found_.clear();
  if (!meetings_.searched().empty()) {
    if (placed_.empty() || !most_stay(boxes)) build(boxes);
    follow(boxes);
    add_pairs();
  }
  sort_.sort(found_.all(), meetings_.primitive_count(), pairs);
}

std::uint64_t Octree::cube_of(const Box& box) const {
  std::uint64_t place = 0;
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, side_of(box, k));
    const double middle = 0.5 * static_cast<double>(box.low[k]) + 0.5 * static_cast<double>(box.high[k]);
    const double share = side_ > 0.0 ? (middle - origin_[k]) / side_ : 0.0;
    place |= spread(static_cast<std::uint64_t>(std::clamp(share * kFinest, 0.0, kFinest - 1.0))) << k;
  }
  unsigned depth = 0;
  for (double side = 0.5 * side_; depth < kDeepest && side >= longest; side *= 0.5) ++depth;
  const unsigned inside = 3 * (kDeepest - depth);  // bits that say where inside the cube
  return (place >> inside << inside) << kDepthBits | depth;
}

bool Octree::most_stay(std::span<const Box> boxes) const {
  std::size_t left = 0;
  for (const Placed& placed : placed_) {
    left += cube_of(boxes[static_cast<std::size_t>(placed.primitive)]) != placed.cube ? 1U : 0U;
  }
  return kChanged * left <= placed_.size();
}

void Octree::build(std::span<const Box> boxes) {
  ++builds_;
  Box all = boxes[static_cast<std::size_t>(meetings_.searched().front())];
  for (const std::int32_t p : meetings_.searched()) all.add(boxes[static_cast<std::size_t>(p)]);
  side_ = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    origin_[k] = static_cast<double>(all.low[k]);
    side_ = std::max(side_, side_of(all, k));
  }
  placed_.clear();
  for (const std::int32_t p : meetings_.searched()) {
    placed_.push_back({cube_of(boxes[static_cast<std::size_t>(p)]), p});
  }
  std::ranges::sort(placed_, [](const Placed& a, const Placed& b) {
    return a.cube < b.cube || (a.cube == b.cube && a.primitive < b.primitive);
  });
  nodes_.clear();
  add_node(0, static_cast<std::int32_t>(placed_.size()), 0);
}

/// The cube at that depth that holds these; it calls itself ten times deep at most.
void Octree::add_node(std::int32_t first, std::int32_t end, int depth) {
  const auto begin = placed_.begin();
  const std::size_t number = nodes_.size();
  nodes_.push_back({Box{}, first, end, end, 0});
  if (end - first > kLeaf && depth < kDeepest) {
    constexpr std::uint64_t depths = (1U << kDepthBits) - 1U;
    const auto is_own = [&](const Placed& placed) {
      return (placed.cube & depths) <= static_cast<std::uint64_t>(depth);
    };
    auto at = std::partition_point(begin + first, begin + end, is_own);
    nodes_[number].own = static_cast<std::int32_t>(at - begin);
    const unsigned inside = 3U * static_cast<unsigned>(kDeepest - depth - 1) + kDepthBits;
    while (at != begin + end) {
      const std::uint64_t cube = at->cube >> inside;
      const auto last = std::partition_point(
          at, begin + end, [&](const Placed& placed) { return placed.cube >> inside == cube; });
      add_node(static_cast<std::int32_t>(at - begin), static_cast<std::int32_t>(last - begin), depth + 1);
      at = last;
    }
  }
  nodes_[number].next = static_cast<std::int32_t>(nodes_.size());
}

void Octree::follow(std::span<const Box> boxes) {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    boxes_[i] = boxes[static_cast<std::size_t>(placed_[i].primitive)];
  }
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    node.box = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    for (std::int32_t i = node.first; i < node.own; ++i) node.box.add(boxes_[static_cast<std::size_t>(i)]);
    for (auto inside = static_cast<std::int32_t>(n) + 1; inside < node.next;) {
      node.box.add(nodes_[static_cast<std::size_t>(inside)].box);
      inside = nodes_[static_cast<std::size_t>(inside)].next;
    }
  }
}

void Octree::add_pairs() {
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(placed_.size()); ++i) add_pairs_after(i);
}

/// Pairs of a box with those that stand after it.
void Octree::add_pairs_after(std::int32_t place) {
  const Box& box = boxes_[static_cast<std::size_t>(place)];
  const std::int32_t primitive = placed_[static_cast<std::size_t>(place)].primitive;
  const auto count = static_cast<std::int32_t>(nodes_.size());
  for (std::int32_t n = 0; n < count;) {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    if (node.end <= place + 1 || !node.box.overlaps(box)) {
      n = node.next;
      continue;
    }
    for (std::int32_t i = std::max(node.first, place + 1); i < node.own; ++i) {
      if (!box.overlaps(boxes_[static_cast<std::size_t>(i)])) continue;
      const std::int32_t other = placed_[static_cast<std::size_t>(i)].primitive;
      if (meetings_.meet(primitive, other)) found_.add(primitive, other);
    }
    ++n;
  }
}

std::size_t Octree::bytes() const {
  return meetings_.bytes() + placed_.capacity() * sizeof(Placed) + boxes_.capacity() * sizeof(Box) +
         nodes_.capacity() * sizeof(Node) + found_.bytes() + sort_.bytes();
}

}  // namespace tissu
