#include "tissu/force/elastic.h"

#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

constexpr int kLanes = ElementOrder::kLanes;

}  // namespace

std::int32_t Elastic::cell_count() const {
  return static_cast<std::int32_t>(block_.cells.size()) / reference_.nodes;
}

bool Elastic::has_constant_stiffness() const {
  return std::ranges::all_of(laws_, [](const LawKernels* law) { return law->linear; });
}

void Elastic::couple(SparsityBuilder& builder) const { builder.add_cells(block_.cells, kernels_->nodes); }

void Elastic::bind(const Sparsity& pattern) {
  const auto n = static_cast<std::size_t>(kernels_->nodes);
  const auto groups = static_cast<std::size_t>(order_.groups());
  slots_.resize(groups * n * n * kLanes);
  threads_.for_pieces(order_.groups(), [&](std::int32_t begin, std::int32_t end) {
    for (auto group = static_cast<std::size_t>(begin); group < static_cast<std::size_t>(end); ++group) {
      std::int32_t* slots = slots_.data() + group * n * n * kLanes;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
          for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::int32_t* cell =
                block_.cells.data() + static_cast<std::size_t>(order_.element[group * kLanes + lane]) * n;
            slots[(a * n + b) * kLanes + lane] = pattern.slot(cell[a], cell[b]);
          }
        }
      }
    }
  });
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

template <class Function>
void Elastic::for_chunks(Function&& f) const {
  for (std::int32_t colour = 0; colour < order_.colours(); ++colour) {
    const std::int32_t begin = order_.colour_begin[static_cast<std::size_t>(colour)];
    const std::int32_t end = order_.colour_begin[static_cast<std::size_t>(colour) + 1];
    threads_.for_each(end - begin,
                      [&](std::int32_t c) { f(order_.chunks[static_cast<std::size_t>(begin + c)]); });
  }
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
  for (std::size_t i = 0; i < lanes; ++i) {
    if (order_.real[i] == 0) continue;
    const auto e = static_cast<std::size_t>(order_.element[i]);
    const auto s = [&](std::size_t k) { return stresses[(i / kLanes * 6 + k) * kLanes + i % kLanes]; };
    const double deviation =
        (s(0) - s(1)) * (s(0) - s(1)) + (s(1) - s(2)) * (s(1) - s(2)) + (s(2) - s(0)) * (s(2) - s(0));
    const double shear = s(3) * s(3) + s(4) * s(4) + s(5) * s(5);
    fields.von_mises[e] = std::sqrt(0.5 * deviation + 3.0 * shear);
    fields.energy_density[e] = stored[i] / shape_.volumes[e];
    fields.volume_ratio[e] = ratios[i];
  }
  return fields;
}

std::size_t Elastic::bytes() const {
  return order_.places.size() * sizeof(std::uint16_t) +
         (order_.nodes.size() + slots_.size()) * sizeof(std::int32_t) +
         (shape_.rest.size() + shape_.frames.size() + constants_.size()) * sizeof(double);
}

std::size_t Elastic::reals_per_cell() const {
  const std::size_t frame = shape_.frames.empty() ? 0 : 9;
  std::size_t own = 0;  // of the law, where cells differ
  if (constants_stride_ != 0) own = static_cast<std::size_t>(constants_stride_) / kLanes;
  return static_cast<std::size_t>(shape_.rest_points) * (shape_.reals + frame) + own;
}

}  // namespace tissu
