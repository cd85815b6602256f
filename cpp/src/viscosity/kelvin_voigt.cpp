#include "tissu/viscosity/kelvin_voigt.h"

namespace tissu {

KelvinVoigt::KelvinVoigt(const ElasticBlock& block, Lame viscosity, ConstReals rest_positions, Isa isa,
                         Threads threads)
    : ViscousCells(block, rest_positions, threads),
      kernels_(find_shape_kernels(isa, reference_.nodes, reference_.dimension)),
      law_(find_viscous_law(isa, reference_.dimension)) {
  if (block_.plane == Plane::stress) viscosity.lambda = free_lambda(viscosity, reference_.dimension);
  constants_.assign(kLanes, viscosity.lambda);
  constants_.insert(constants_.end(), kLanes, viscosity.mu);
}

ElasticView KelvinVoigt::rate_view() const {
  ElasticView v = view();
  v.laws = &law_;
  v.law_count = 1;
  return v;
}

void KelvinVoigt::add_rate(ConstReals x, double scale, ConstReals p, Reals out) const {
  const ElasticView v = rate_view();
  for_chunks([&](const Chunk& chunk) { kernels_->product(v, chunk, x.data(), scale, p.data(), out.data()); });
}

void KelvinVoigt::add_force(const State& state, Reals f) const {
  add_rate(state.positions, 1.0, state.velocities, f);
}

void KelvinVoigt::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  if (scale.velocity != 0.0) add_rate(state.positions, scale.velocity, p, out);
}

void KelvinVoigt::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  if (scale.velocity == 0.0) return;
  const ElasticView v = rate_view();
  double* values = matrix.values();
  for_chunks([&](const Chunk& chunk) {
    kernels_->stiffness(v, chunk, state.positions.data(), scale.velocity, values);
  });
}

}  // namespace tissu
