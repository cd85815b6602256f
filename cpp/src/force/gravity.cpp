#include "tissu/force/gravity.h"

#include <utility>

namespace tissu {

Gravity::Gravity(std::vector<double> masses, Vec3 acceleration)
    : masses_(std::move(masses)), acceleration_(std::move(acceleration)) {}

void Gravity::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const Vec3 g = state.load_factor * acceleration_;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) f[3 * i + k] += masses_[i] * g[static_cast<int>(k)];
  }
}

double Gravity::energy(const State& state, Scratch& /*scratch*/) const {
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    moment += masses_[i] * block(ConstReals(state.positions), static_cast<std::int32_t>(i));
  }
  return -state.load_factor * acceleration_.dot(moment);
}

}  // namespace tissu
