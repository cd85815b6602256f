#pragma once

/// The rows that a contact moves with, each once: vertices that the same rows carry have shares of them that
/// add up before they are squared.

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "tissu/assembly/couplings.h"

namespace tissu {

class MergedParts {
 public:
  static constexpr std::size_t kMost = 108;  ///< four vertices, each of a cell of 27 nodes

  void add(const CarriedPart& part) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (parts_[i].row != part.row || part.turns) continue;
      parts_[i].weight += part.weight;
      return;
    }
    assert(count_ < kMost);
    parts_[count_++] = part;
  }
  [[nodiscard]] std::span<const CarriedPart> all() const { return std::span(parts_).first(count_); }

 private:
  std::array<CarriedPart, kMost> parts_;
  std::size_t count_ = 0;
};

}  // namespace tissu
