#include "tissu/viscosity/viscous_cells.h"

namespace tissu {

ViscousCells::ViscousCells(const ElasticBlock& block, ConstReals rest_positions, Threads threads)
    : CellModel(block, threads) {
  lay_cells(rest_positions, {.frames = false, .triangular = false});
  for (const ReferenceCell::Point& point : reference_.points) {
    for (const auto& gradient : point.gradients) {
      gradients_.insert(gradients_.end(), gradient.begin(), gradient.begin() + reference_.dimension);
    }
  }
}

ElasticView ViscousCells::view() const {
  return {.places = order_.places.data(),
          .slots = slots_.data(),
          .rest = shape_.rest.data(),
          .rest_points = shape_.rest_points,
          .weights = shape_.weights.data(),
          .frames = nullptr,
          .constants = constants_.data(),
          .constants_stride = constants_stride_,
          .gradients = gradients_.data(),
          .points = static_cast<int>(reference_.points.size()),
          .laws = nullptr,
          .law_count = 0};
}

std::size_t ViscousCells::bytes() const {
  return CellModel::bytes() + (shape_.rest.size() + constants_.size()) * sizeof(double);
}

std::size_t ViscousCells::reals_per_cell() const {
  return static_cast<std::size_t>(shape_.rest_points) * shape_.reals;
}

}  // namespace tissu
