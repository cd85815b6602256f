#include "tissu/viscosity/kelvin_voigt.h"

#include "tissu/viscosity/viscous_law.h"

namespace tissu {

KelvinVoigt::KelvinVoigt(const ElasticBlock& block, Lame viscosity, ConstReals rest_positions, Isa isa,
                         Threads threads)
    : ViscousCells(block, rest_positions, threads),
      kernels_(find_shape_kernels(isa, reference_.nodes, reference_.dimension)),
      law_(find_viscous_law(isa, reference_.dimension)) {
  if (block_.plane != Plane::strain) viscosity.lambda = free_lambda(viscosity, reference_.dimension);
  constants_.assign(kLanes, viscosity.lambda);
  constants_.insert(constants_.end(), kLanes, viscosity.mu);
}

Loops<ElasticKernels, ElasticView> KelvinVoigt::loops() const {
  ElasticView v = view();
  v.laws = &law_;
  v.law_count = 1;
  v.at_point = kernels_->at_point;
  return {*kernels_, v, order_};
}

void KelvinVoigt::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  product_by(loops(), state.positions, 1.0, state.strains_by(), f);
}

void KelvinVoigt::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                              Reals out) const {
  product_by(loops(), state.positions, scale.velocity, p, out);
}

void KelvinVoigt::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                                BlockMatrix& matrix) const {
  stiffness_by(loops(), state.positions, {.position = scale.velocity}, matrix);
}

}  // namespace tissu
