#pragma once

#include <cstddef>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// Anderson's acceleration of a fixed-point iteration x = G(x) (Anderson 1965; Walker, Ni 2011): the next
/// iterate is the one that the latest differences, combined so that G(x) - x is least, lead to.
class Anderson {
 public:
  static constexpr int kMost = 8;

  /// `depth` differences are kept, 0 to kMost; 0 is the plain iteration.
  explicit Anderson(int depth) : depth_(depth) {}
  void resize(std::size_t size);
  void begin() { count_ = 0; }
  /// x becomes the next iterate; `change` is G(x) - x, of which the share `mixing` is taken. Entries count by
  /// `weight`.
  void advance(Reals x, ConstReals change, double mixing, ConstReals weight);

 private:
  int depth_;
  int count_ = 0;  ///< iterates seen since `begin`
  std::vector<double> x_;
  std::vector<double> change_;
  std::vector<std::vector<double>> x_differences_;
  std::vector<std::vector<double>> change_differences_;
};

}  // namespace tissu
