#include "tissu/model/elastic.h"

#include <algorithm>

namespace tissu {
bool Elastic::has_constant_stiffness() const {
  return std::ranges::all_of(laws_, [](const LawKernels* law) { return law->linear; });
}

ElasticView Elastic::view() const {
  return {.places = order_.places.data(),
          .slots = slots_.data(),
          .rest = shape_.rest.data(),
          .rest_points = shape_.rest_points,
          .weights = shape_.weights.data(),
          .frames = shape_.frames.empty() ? nullptr : shape_.frames.data(),
          .constants = constants_.data(),
          .constants_stride = constants_stride_,
          .gradients = gradients_.data(),
          .points = static_cast<int>(reference_.points.size()),
          .laws = laws_.data(),
          .law_count = static_cast<int>(laws_.size())};
}

void Elastic::add_force(const State& state, Reals f) const {
  const ElasticView v = view();
  for_chunks([&](const Chunk& chunk) { kernels_->force(v, chunk, state.positions.data(), f.data()); });
}

void Elastic::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  if (scale.position == 0.0) return;
  const ElasticView v = view();
  double* values = matrix.values();
  for_chunks([&](const Chunk& chunk) {
    kernels_->stiffness(v, chunk, state.positions.data(), scale.position, values);
  });
}

void Elastic::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  if (scale.position == 0.0) return;
  const ElasticView v = view();
  for_chunks([&](const Chunk& chunk) {
    kernels_->product(v, chunk, state.positions.data(), scale.position, p.data(), out.data());
  });
}

std::vector<double> Elastic::energies(const State& state) const {
  std::vector<double> result(order_.element.size(), 0.0);
  const ElasticView v = view();
  for_chunks([&](const Chunk& chunk) { kernels_->energy(v, chunk, state.positions.data(), result.data()); });
  return result;
}

double Elastic::energy(const State& state) const {
  double sum = 0.0;
  for (const double e : energies(state)) sum += e;
  return sum;
}

CellFields Elastic::fields(const State& state) const {
  const std::size_t lanes = order_.element.size();
  std::vector<double> stresses(6 * lanes);
  std::vector<double> ratios(lanes);
  const ElasticView v = view();
  for_chunks([&](const Chunk& chunk) {
    kernels_->stress(v, chunk, state.positions.data(), stresses.data(), ratios.data());
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

std::size_t Elastic::bytes() const {
  return CellModel::bytes() +
         (shape_.rest.size() + shape_.frames.size() + constants_.size()) * sizeof(double);
}

std::size_t Elastic::reals_per_cell() const {
  const std::size_t frame = shape_.frames.empty() ? 0 : 9;
  std::size_t own = 0;  // of the law, where cells differ
  if (constants_stride_ != 0) own = static_cast<std::size_t>(constants_stride_) / kLanes;
  return static_cast<std::size_t>(shape_.rest_points) * (shape_.reals + frame) + own;
}

}  // namespace tissu
