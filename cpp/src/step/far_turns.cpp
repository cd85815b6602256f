/// Steps in which nodes turn too far for what is linear.
///
/// The norm of a residual hardly sees a node with little mass, such as one of a small copy that a cut made. A
/// system may turn it by any angle, and the step would end far from the solution of its equation.

#include <algorithm>

#include "tissu/step/stage.h"

namespace tissu {
namespace {

constexpr double kFar = 0.5;  ///< [rad]

}  // namespace

void StageSolver::list_turning() {
  const World& world = system_->world();
  turning_.clear();
  for (const Frame& frame : world.frames()) {
    if (frame.alone || world.fixed().masks()[static_cast<std::size_t>(frame.rotation)] != 0) continue;
    turning_.push_back(frame.rotation);
  }
}

bool StageSolver::turns_far(ConstReals v) const {
  const ConstReals guess(guess_);
  return std::ranges::any_of(turning_, [&](std::int32_t row) {
    return !(stage_.move * (block(v, row) - block(guess, row)).norm() <= kFar);
  });
}

}  // namespace tissu
