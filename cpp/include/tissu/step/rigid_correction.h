#pragma once

/// What a step that is linearised once leaves of the rigid motions of parts, and the velocities that cure it.

#include <cstdint>
#include <vector>

#include "tissu/step/part_balance.h"

namespace tissu {

/// The forces within a part have neither a sum nor a moment, wherever its nodes are. Those of a step that is
/// linearised once have a moment at its end, which changes the spin of the part; the residual r holds it. The
/// cure is a step of Newton's method among the rigid motions Z that supports allow (Galerkin):
/// Z^T (M - push move K) Z d = Z^T r, v += Z d. Only what holds a part from outside is in K.
class RigidCorrection {
 public:
  void prepare(const World& world, const PartBalance& balance);  ///< which have to stay where they are
  /// Adds those motions to v where the residual at `at` holds more than little of what moves the part or acts
  /// on it, and they do not lead far; push and move are those of the stage. False: nowhere.
  bool correct(const State& at, double push, double move, ConstReals residual, ConstReals momentum_change,
               Reals v);
  /// Gives back to v, from what it was before the latest correction, the parts of which the residual after it
  /// holds more than the one before it did: what holds them is stiffer than its stiffness there. How many.
  int take_back(const State& at, ConstReals residual, ConstReals before, Reals v) const;
  /// Of so many parts v was corrected.
  [[nodiscard]] int corrected() const { return static_cast<int>(corrected_.size()); }

 private:
  struct Corrected {
    const ConnectedPart* part;
    double left;  ///< sqrt(r^T Z (Z^T M Z)^-1 Z^T r) [kg^1/2 m/s]
  };
  const World* world_ = nullptr;
  const PartBalance* balance_ = nullptr;
  std::vector<std::size_t> moving_;  ///< parts that supports allow a rigid motion
  std::vector<Corrected> corrected_;
  std::vector<double> motion_;
  std::vector<double> product_;
  Scratch scratch_;
};

}  // namespace tissu
