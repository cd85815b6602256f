#include "tissu/step/load_path.h"

#include <algorithm>

namespace tissu {

LoadPath::LoadPath(const World& world, const State& start, double h, bool is_loaded)
    : world_(world), start_(start), way_{start.time, start.time + h, !is_loaded}, is_loaded_(is_loaded) {}

void LoadPath::load(double share, State& state) const {
  state.time = is_loaded_ && share != 1.0 ? way_.time(share) : way_.to;
  state.load_factor = is_loaded_ ? 1.0 : share;
}

void LoadPath::set_way(double before, double share, const State& now, Reals change) const {
  std::ranges::fill(change, 0.0);
  world_.fixed().set_way(way_, start_, before, share, now, change);
}

double LoadPath::largest_part(double turn) const {
  const double largest = world_.fixed().largest_turn(way_, start_);
  return largest > turn * (1.0 + 1e-9) ? turn / largest : 1.0;
}

}  // namespace tissu
