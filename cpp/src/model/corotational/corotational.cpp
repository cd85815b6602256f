#include "tissu/model/corotational/corotational.h"

namespace tissu {

Loops<CorotationalKernels, CorotationalView> Corotational::loops(const CorotationalKernels& kernels) const {
  return {kernels, {cell_view(), centres_.empty() ? nullptr : centres_.data(), rotation_}, order_};
}

void Corotational::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  force_by(loops(*forces_), state.positions, f);
}

void Corotational::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                                 BlockMatrix& matrix) const {
  stiffness_by(loops(*tangents_), state.positions, scale, matrix);
}

void Corotational::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                               Reals out) const {
  product_by(loops(*tangents_), state.positions, scale.position, p, out);
}

double Corotational::energy(const State& state, Scratch& scratch) const {
  return energy_by(loops(*forces_), state.positions, scratch);
}

void Corotational::add_part_energies(const State& state, Scratch& scratch,
                                     std::span<const std::int32_t> part_of, Reals energies) const {
  add_by_part(order_, energies_by(loops(*forces_), state.positions, scratch), block_.cells,
              static_cast<std::size_t>(reference_.nodes), part_of, energies);
}

CellFields Corotational::fields(const State& state) const {
  return fields_by(loops(*forces_), state.positions);
}

std::size_t Corotational::bytes() const {
  return CellModel::bytes() + (shape_.rest.size() + centres_.size() + constants_.size()) * sizeof(double);
}

std::size_t Corotational::reals_per_cell() const {
  const std::size_t centre = centres_.empty() ? 0 : 6;
  const std::size_t own = constants_stride_ == 0 ? 0 : 2;  // lambda and mu, where cells differ
  return static_cast<std::size_t>(shape_.rest_points) * shape_.reals + centre + own;
}

}  // namespace tissu
