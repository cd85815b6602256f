#include "tissu/solve/linear_solver.h"

#include <algorithm>

namespace tissu {

double attainable(const LinearOperator& A, ConstReals x, double reference, double tolerance) {
  constexpr double kTimes = 16.0;  // several roundings in each row
  constexpr double kWorst = 1e-8;
  return std::max(tolerance, std::min(kWorst, kTimes * A.round_off(x) / reference));
}

}  // namespace tissu
