#include "tissu/simulation/energy_watch.h"

#include <algorithm>

#include "tissu/base/number_text.h"

namespace tissu {

Energy energy_of(const World& world, const State& state, Scratch& scratch) {
  Energy energy;
  energy.kinetic = world.mass().kinetic_energy(state);
  for (const auto& model : world.forces()) {
    (model->kind() == ForceKind::elastic ? energy.elastic : energy.potential) +=
        model->energy(state, scratch);
  }
  return energy;
}

bool EnergyWatch::can_watch(const World& world) {
  if (world.fixed().moves() || !world.frames().empty()) return false;
  return std::ranges::none_of(world.forces(), [](const auto& model) { return model->may_add_energy(); });
}

void EnergyWatch::begin(const World& world, const State& state) {
  if (end_.is(state)) return;
  const Energy energy = energy_of(world, state, scratch_);
  total_ = energy.total();
  largest_ = std::max(largest_, energy.kinetic + energy.elastic);
}

void EnergyWatch::end(const World& world, const State& state) {
  const Energy energy = energy_of(world, state, scratch_);
  gained_ += energy.total() - total_;
  total_ = energy.total();
  // What moves and is strained without having been gained, as in a fall.
  const double own = energy.kinetic + energy.elastic - std::max(gained_, 0.0);
  largest_ = std::max(largest_, own);
  end_.set(state);
}

std::string EnergyWatch::say() const {
  return "the energy has grown by " + number_text(100.0 * growth()) +
         " % of what the bodies had, and nothing in the scene gives any; take energy_momentum, which keeps "
         "it, a smaller dt, or a method that damps (implicit_euler, bdf2)";
}

}  // namespace tissu
