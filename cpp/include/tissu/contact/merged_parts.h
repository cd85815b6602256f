#pragma once

/// The rows that a contact moves with, each once: vertices that the same rows carry have shares of them that
/// add up before they are squared. Of a rotation the levers add up.

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "tissu/assembly/couplings.h"

namespace tissu {

template <std::size_t most>
class MergedPartsOf {
 public:
  void add(const CarriedPart& part) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (parts_[i].row != part.row) continue;
      if (part.turns) {
        parts_[i].arm = parts_[i].weight * parts_[i].arm + part.weight * part.arm;
        parts_[i].weight = 1.0;
      } else {
        parts_[i].weight += part.weight;
      }
      return;
    }
    assert(count_ < most);
    parts_[count_++] = part;
  }
  [[nodiscard]] std::span<const CarriedPart> all() const { return std::span(parts_).first(count_); }

 private:
  std::array<CarriedPart, most> parts_;
  std::size_t count_ = 0;
};

/// Of four vertices, each of a cell of 27 nodes; …
using MergedParts = MergedPartsOf<108>;
/// … and of four that frames carry, each of 64 at most, with their rotations.
inline constexpr std::size_t kMostFrames = 64;
using MergedTurningParts = MergedPartsOf<4 * 2 * kMostFrames>;

}  // namespace tissu
