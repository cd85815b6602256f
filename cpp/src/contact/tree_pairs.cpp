#include "contact/tree_pairs.h"

#include <bit>

namespace tissu {
namespace {

using Node = BoxTree::Node;
using Leaf = BoxTree::Leaf;
constexpr std::size_t kLeaf = BoxTree::kLeaf;

/// Four numbers at once; a comparison gives 0 or -1 in each.
using Lanes = float __attribute__((vector_size(kLeaf * sizeof(float))));
using Signs = std::int32_t __attribute__((vector_size(kLeaf * sizeof(std::int32_t))));

/// Which primitives of a leaf overlap a box: -1, or else 0.
std::array<std::int32_t, kLeaf> hits(const Leaf& leaf, const Box& box) {
  Signs hit = ~Signs{};
  for (std::size_t k = 0; k < 3; ++k) {
    hit &= std::bit_cast<Lanes>(leaf.low[k]) <= Lanes{} + box.high[k];
    hit &= Lanes{} + box.low[k] <= std::bit_cast<Lanes>(leaf.high[k]);
  }
  return std::bit_cast<std::array<std::int32_t, kLeaf>>(hit);
}

Box box_of(const Leaf& leaf, std::size_t i) {
  return {{leaf.low[0][i], leaf.low[1][i], leaf.low[2][i]},
          {leaf.high[0][i], leaf.high[1][i], leaf.high[2][i]}};
}

/// Room is there for kLeaf more.
void put_hits(const Leaf& leaf, const Box& box, std::int32_t primitive, std::size_t from, FoundPairs& found) {
  const std::array<std::int32_t, kLeaf> hit = hits(leaf, box);
  for (std::size_t i = from; i < kLeaf; ++i) found.put(primitive, leaf.primitive[i], hit[i] != 0);
}

void test_leaves(const Leaf& a, std::int32_t count, const Leaf& b, FoundPairs& found) {
  found.expect(kLeaf * kLeaf);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    put_hits(b, box_of(a, i), a.primitive[i], 0, found);
  }
}

void test_leaf(const Leaf& leaf, std::int32_t count, FoundPairs& found) {
  found.expect(kLeaf * kLeaf);
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(count); ++i) {
    put_hits(leaf, box_of(leaf, i), leaf.primitive[i], i + 1, found);
  }
}

/// Pairs of nodes that are still to be looked into. The deepest tree leaves three of them at each level.
struct Waiting {
  struct Two {
    std::int32_t a;
    std::int32_t b;
  };
  std::array<Two, 8 * (BoxTree::kDeepest + 1)> nodes;
  std::size_t count = 0;
  void push(std::int32_t a, std::int32_t b) { nodes[count++] = {a, b}; }
  Two pop() { return nodes[--count]; }
};

/// Looks into pairs of nodes that overlap until none waits.
void finish(const BoxTree& a, const BoxTree& b, Waiting& waiting, FoundPairs& found) {
  const Node* const of_a = a.nodes().data();
  const Node* const of_b = b.nodes().data();
  const auto look = [&](std::int32_t i, std::int32_t j) {
    if (of_a[i].box.overlaps(of_b[j].box)) waiting.push(i, j);
  };
  while (waiting.count > 0) {
    const auto [i, j] = waiting.pop();
    const Node& p = of_a[i];
    const Node& q = of_b[j];
    if (p.count > 0 && q.count > 0) {
      test_leaves(a.leaf(p), p.count, b.leaf(q), found);
    } else if (p.count > 0) {
      look(i, q.first);
      look(i, q.first + 1);
    } else if (q.count > 0) {
      look(p.first, j);
      look(p.first + 1, j);
    } else {
      look(p.first, q.first);
      look(p.first, q.first + 1);
      look(p.first + 1, q.first);
      look(p.first + 1, q.first + 1);
    }
  }
}

}  // namespace

void add_pairs_within(const BoxTree& tree, FoundPairs& found) {
  Waiting waiting;
  for (const Node& node : tree.nodes()) {
    if (node.count > 0) {
      test_leaf(tree.leaf(node), node.count, found);
      continue;
    }
    const auto left = tree.nodes()[static_cast<std::size_t>(node.first)].box;
    const auto right = tree.nodes()[static_cast<std::size_t>(node.first) + 1].box;
    if (!left.overlaps(right)) continue;
    waiting.push(node.first, node.first + 1);
    finish(tree, tree, waiting, found);
  }
}

void add_pairs_between(const BoxTree& a, const BoxTree& b, FoundPairs& found) {
  if (a.nodes().empty() || b.nodes().empty()) return;
  if (!a.nodes()[0].box.overlaps(b.nodes()[0].box)) return;
  Waiting waiting;
  waiting.push(0, 0);
  finish(a, b, waiting, found);
}

void add_pairs_with(const BoxTree& tree, const Box& box, std::int32_t primitive, FoundPairs& found) {
  if (tree.nodes().empty() || !tree.nodes()[0].box.overlaps(box)) return;
  std::array<std::int32_t, 2 * (BoxTree::kDeepest + 1)> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Node& node = tree.nodes()[static_cast<std::size_t>(waiting[--count])];
    if (node.count > 0) {
      found.expect(kLeaf);
      put_hits(tree.leaf(node), box, primitive, 0, found);
      continue;
    }
    for (const std::int32_t child : {node.first, node.first + 1}) {
      if (tree.nodes()[static_cast<std::size_t>(child)].box.overlaps(box)) waiting[count++] = child;
    }
  }
}

}  // namespace tissu
