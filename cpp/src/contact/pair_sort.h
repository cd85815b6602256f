#pragma once

/// Pairs in the order in which a search meets them, and how they come into ascending order.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/contact/broad_phase.h"

namespace tissu {

/// Pairs as they are found. A pair is written first and counted afterwards, so that no branch
/// depends on whether it is one.
class FoundPairs {
 public:
  void clear() { count_ = 0; }
  /// Makes room for that many more.
  void expect(std::size_t more) {
    if (count_ + more > pairs_.size()) pairs_.resize(std::max(2 * pairs_.size(), count_ + more));
  }
  /// The pair counts if `holds`. There is room for it.
  void put(std::int32_t p, std::int32_t q, bool holds) {
    pairs_[count_] = {std::min(p, q), std::max(p, q)};
    count_ += holds ? 1U : 0U;
  }
  void add(std::int32_t p, std::int32_t q) {
    expect(1);
    put(p, q, true);
  }
  /// Of pairs that were found several times one stays.
  void remove_repeated() {
    const auto begin = pairs_.begin();
    std::sort(begin, begin + static_cast<std::ptrdiff_t>(count_));
    count_ =
        static_cast<std::size_t>(std::unique(begin, begin + static_cast<std::ptrdiff_t>(count_)) - begin);
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Of the pairs from number `first` on, those stay for which `holds(a, b)`.
  template <class Holds>
  void keep_if(std::size_t first, Holds&& holds) {
    std::size_t kept = first;
    for (std::size_t i = first; i < count_; ++i) {
      const BoxPair pair = pairs_[i];
      pairs_[kept] = pair;
      kept += holds(pair.a, pair.b) ? 1U : 0U;
    }
    count_ = kept;
  }
  [[nodiscard]] std::span<const BoxPair> all() const { return {pairs_.data(), count_}; }
  [[nodiscard]] std::size_t bytes() const { return pairs_.capacity() * sizeof(BoxPair); }

 private:
  std::vector<BoxPair> pairs_;
  std::size_t count_ = 0;
};

/// A radix sort with two digits, the numbers of the primitives: one pass brings together the pairs of one a,
/// whose few b are then sorted in place.
class PairSort {
 public:
  /// `sorted` becomes the pairs of `found`, which are all different, ascending. Their numbers are below
  /// `primitives`.
  void sort(std::span<const BoxPair> found, std::int32_t primitives, std::vector<BoxPair>& sorted);
  [[nodiscard]] std::size_t bytes() const {
    return end_.capacity() * sizeof(std::size_t) + second_.capacity() * sizeof(std::int32_t);
  }

 private:
  std::vector<std::size_t> end_;      ///< of the pairs of each a
  std::vector<std::int32_t> second_;  ///< b of pairs, a by a
};

}  // namespace tissu
