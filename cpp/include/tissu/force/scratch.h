#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "tissu/base/array.h"

namespace tissu {

/// Room that force models work in while they compute. It belongs to the caller, one for each caller,
/// so that several may compute with one constant world at the same time.
class Scratch {
 public:
  /// Takes the room before the first step.
  void reserve(std::size_t count) {
    if (reals_.size() < count) reals_.resize(count);
  }
  /// So many numbers of any value, aligned, until the next call. Takes more room where there is less.
  [[nodiscard]] std::span<double> reals(std::size_t count) {
    reserve(count);
    return {reals_.data(), count};
  }
  [[nodiscard]] std::size_t bytes() const { return reals_.size() * sizeof(double); }

 private:
  AlignedVector<double> reals_;
};

}  // namespace tissu
