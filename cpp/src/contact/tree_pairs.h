#pragma once

/// The pairs of primitives whose boxes overlap, by two trees at once.

#include "contact/box_tree.h"
#include "contact/pair_sort.h"

namespace tissu {

/// Pairs of primitives of one tree, each once.
void add_pairs_within(const BoxTree& tree, FoundPairs& found);
/// Pairs of a primitive of one tree and a primitive of another.
void add_pairs_between(const BoxTree& a, const BoxTree& b, FoundPairs& found);
/// Pairs of a primitive of the tree and `primitive`, whose box is given.
void add_pairs_with(const BoxTree& tree, const Box& box, std::int32_t primitive, FoundPairs& found);

}  // namespace tissu
