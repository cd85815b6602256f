#pragma once

#include <cmath>

#include "tissu/base/vec.h"

namespace tissu {

/// Euclidean norm of a long array.
inline double norm(ConstReals values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum);
}

}  // namespace tissu
