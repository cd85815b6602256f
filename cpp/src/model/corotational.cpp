#include "tissu/model/corotational.h"

namespace tissu {

CorotationalView Corotational::view() const {
  return {.cells = {.places = order_.places.data(),
                    .slots = slots_.data(),
                    .rest = shape_.rest.data(),
                    .rest_points = shape_.rest_points,
                    .weights = shape_.weights.data(),
                    .frames = nullptr,
                    .constants = constants_.data(),
                    .constants_stride = constants_stride_,
                    .gradients = nullptr,
                    .points = static_cast<int>(reference_.points.size()),
                    .laws = nullptr,
                    .law_count = 1},
          .centres = centres_.empty() ? nullptr : centres_.data(),
          .rotation = rotation_};
}

void Corotational::add_force(const State& state, Reals f) const {
  const CorotationalView v = view();
  for_chunks([&](const Chunk& chunk) { forces_->force(v, chunk, state.positions.data(), f.data()); });
}

void Corotational::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  if (scale.position == 0.0) return;
  const CorotationalView v = view();
  double* values = matrix.values();
  for_chunks([&](const Chunk& chunk) {
    tangents_->stiffness(v, chunk, state.positions.data(), scale.position, values);
  });
}

void Corotational::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  if (scale.position == 0.0) return;
  const CorotationalView v = view();
  for_chunks([&](const Chunk& chunk) {
    tangents_->product(v, chunk, state.positions.data(), scale.position, p.data(), out.data());
  });
}

std::vector<double> Corotational::energies(const State& state) const {
  std::vector<double> result(order_.element.size(), 0.0);
  const CorotationalView v = view();
  for_chunks([&](const Chunk& chunk) { forces_->energy(v, chunk, state.positions.data(), result.data()); });
  return result;
}

double Corotational::energy(const State& state) const {
  double sum = 0.0;
  for (const double e : energies(state)) sum += e;
  return sum;
}

CellFields Corotational::fields(const State& state) const {
  const std::size_t lanes = order_.element.size();
  std::vector<double> stresses(6 * lanes);
  std::vector<double> ratios(lanes);
  const CorotationalView v = view();
  for_chunks([&](const Chunk& chunk) {
    forces_->stress(v, chunk, state.positions.data(), stresses.data(), ratios.data());
  });
  const std::vector<double> stored = energies(state);
  CellFields fields;
  const auto cells = static_cast<std::size_t>(cell_count());
  fields.von_mises.resize(cells);
  fields.energy_density.resize(cells);
  fields.volume_ratio.resize(cells);
  for_lanes([&](std::size_t lane, std::size_t cell) {
    fields.von_mises[cell] = von_mises(stresses.data(), lane);
    fields.energy_density[cell] = stored[lane] / shape_.volumes[cell];
    fields.volume_ratio[cell] = ratios[lane];
  });
  return fields;
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
