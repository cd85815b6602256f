#pragma once

#include <cstdint>

#include "tissu/assembly/linear_operator.h"

namespace tissu {

/// Whether what a solver made before its first solve serves that solve: only for the same operator with the
/// same values and places, to the last bit.
class Ahead {
 public:
  void made(const LinearOperator& A);
  /// Something was made, and no solve has asked for it yet.
  [[nodiscard]] bool waits() const { return waits_; }
  /// Whether it was made of this operator. It does not wait any more.
  bool serves(const LinearOperator& A);

 private:
  std::uint64_t id_ = 0;
  std::uint64_t print_ = 0;
  bool waits_ = false;
};

}  // namespace tissu
