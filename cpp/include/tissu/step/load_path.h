#pragma once

#include "tissu/world/world.h"

namespace tissu {

/// What acts in a static step at each share of it, from 0 at its start to 1 at its end. In the first step the
/// external loads of the end grow from nothing in proportion to the share; in later ones time goes on with it
/// and the loads follow their histories. Led nodes follow their motion in every step.
class LoadPath {
 public:
  /// `start` stays as it is while the path is followed.
  LoadPath(const World& world, const State& start, double h, bool is_loaded);

  /// The time at which what is led stands at a share [s].
  [[nodiscard]] double time(double share) const { return way_.time(share); }
  /// Sets the time and the load factor of a share.
  void load(double share, State& state) const;
  /// What moves led nodes of `now`, which stands at the share `before`, to the share; zero elsewhere.
  void set_way(double before, double share, const State& now, Reals change) const;
  /// The largest part of the path in which no node is led round by more than `turn` [rad].
  [[nodiscard]] double largest_part(double turn) const;

 private:
  const World& world_;
  const State& start_;
  LedWay way_;
  bool is_loaded_;
};

}  // namespace tissu
