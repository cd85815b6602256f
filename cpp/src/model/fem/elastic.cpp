#include "tissu/model/fem/elastic.h"

#include <algorithm>
#include <utility>

#include "tissu/model/points/elastic_points.h"

namespace tissu {
bool Elastic::has_constant_stiffness() const {
  return std::ranges::all_of(laws_, [](const LawKernels* law) { return law->linear; });
}

Loops<ElasticKernels, ElasticView> Elastic::loops() const {
  ElasticView view = cell_view();
  view.frames = shape_.frames.empty() ? nullptr : shape_.frames.data();
  view.gradients = gradients_.data();
  view.laws = laws_.data();
  view.law_count = static_cast<int>(laws_.size());
  view.at_point = kernels_->at_point;
  return {*kernels_, view, order_};
}

void Elastic::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  force_by(loops(), state.positions, f);
}

void Elastic::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                            BlockMatrix& matrix) const {
  stiffness_by(loops(), state.positions, scale, matrix);
}

void Elastic::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                          Reals out) const {
  product_by(loops(), state.positions, scale.position, p, out);
}

double Elastic::energy(const State& state, Scratch& scratch) const {
  return energy_by(loops(), state.positions, scratch);
}

void Elastic::add_part_energies(const State& state, Scratch& scratch, std::span<const std::int32_t> part_of,
                                Reals energies) const {
  add_by_part(order_, energies_by(loops(), state.positions, scratch), block_.cells,
              static_cast<std::size_t>(reference_.nodes), part_of, energies);
}

void Elastic::add_energies(const Chunk& chunk, ConstReals x, Reals lanes) const {
  const auto with = loops();
  with.kernels.energy(with.view, chunk, x.data(), lanes.data());
}

/// What the kernels of sheets and lines do not compute, how they thin, the points do.
CellFields Elastic::fields(const State& state) const {
  CellFields fields = fields_by(loops(), state.positions);
  if (reference_.dimension == 3) return fields;
  CellFields thinned = cell_means(point_fields({X_, state, isa_}));
  fields.von_mises = std::move(thinned.von_mises);
  fields.volume_ratio = std::move(thinned.volume_ratio);
  return fields;
}

PointFields Elastic::point_fields(const PointQuery& query) const { return elastic_points(block_, query); }

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
