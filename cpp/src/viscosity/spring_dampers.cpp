#include "tissu/viscosity/spring_dampers.h"

namespace tissu {

SpringDampers::SpringDampers(const DampedSprings& springs, Lame viscosity) : springs_(springs) {
  const double traction = free_lambda(viscosity, 1) + 2.0 * viscosity.mu;
  for (const double share : springs.shares()) damping_.push_back(traction * share);
}

void SpringDampers::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  springs_.add_damping(damping_.data(), state.positions, 1.0, state.strains_by(), f);
}

void SpringDampers::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                                Reals out) const {
  if (scale.velocity != 0.0) {
    springs_.add_damping(damping_.data(), state.positions, scale.velocity, p, out);
  }
}

void SpringDampers::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                                  BlockMatrix& matrix) const {
  if (scale.velocity != 0.0) springs_.add_damping(damping_.data(), state.positions, scale.velocity, matrix);
}

}  // namespace tissu
