#pragma once

/// Boxes in boxes: a binary tree over some primitives, in a flat array, that follows them as they move.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/contact/boxes.h"

namespace tissu {

class BoxTree {
 public:
  static constexpr std::int32_t kLeaf = 4;  ///< primitives at most
  /// Splits by cost go so deep, halves go on: no tree is deeper than 48 + 31.
  static constexpr std::int32_t kDeepest = 80;

  struct Node {
    Box box;
    std::int32_t first;  ///< of a leaf, its number; else the left child, whose right one follows
    std::int32_t count;  ///< of a leaf, how many primitives; else 0
  };
  /// Boxes of a leaf's primitives, axis by axis. What is beyond `count` overlaps nothing.
  struct alignas(16) Leaf {
    std::array<std::array<float, kLeaf>, 3> low;
    std::array<std::array<float, kLeaf>, 3> high;
    std::array<std::int32_t, kLeaf> primitive;
  };

  /// Takes the memory that a tree of so many primitives can need.
  void reserve(std::size_t primitives);
  /// The tree of `primitives`, numbers of boxes, made anew: each set is cut in two where the sum of areas
  /// times numbers is least, among 16 slices along the longest side of the boxes' middles.
  void build(std::span<const Box> boxes, std::span<const std::int32_t> primitives);
  /// The boxes have moved. True when the cost of a search has grown 1.6 times since the tree was built, so
  /// that it should be built again.
  [[nodiscard]] bool refit(std::span<const Box> boxes);

  /// The root comes first, children after their parents. Empty without primitives.
  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  [[nodiscard]] const Leaf& leaf(const Node& node) const {
    return leaves_[static_cast<std::size_t>(node.first)];
  }
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Entry {
    Box box;
    std::int32_t primitive;
  };
  struct Part {
    std::int32_t node;
    std::int32_t first;  ///< of `entries_`
    std::int32_t count;
    std::int32_t depth;
  };
  /// Areas of all boxes of the tree, and of the primitives' own. Their ratio is the cost.
  struct Areas {
    double nodes = 0.0;
    double primitives = 0.0;
  };
  void make_leaf(const Part& part);
  std::int32_t cut(const Part& part);
  std::int32_t halve(const Part& part, const Box& middles);
  Areas follow(std::span<const Box> boxes);

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<Entry> entries_;
  Areas built_;
};

}  // namespace tissu
