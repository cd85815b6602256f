#include "tissu/viscosity/viscous_cells.h"

namespace tissu {

ViscousCells::ViscousCells(const ElasticBlock& block, ConstReals rest_positions, Threads threads)
    : CellModel(block, threads) {
  lay_cells(rest_positions, {.frames = false, .triangular = false});
  gradients_ = reference_gradients();
}

ElasticView ViscousCells::view() const {
  ElasticView view = cell_view();
  view.gradients = gradients_.data();
  return view;
}

std::size_t ViscousCells::bytes() const {
  return CellModel::bytes() + (shape_.rest.size() + constants_.size()) * sizeof(double);
}

std::size_t ViscousCells::reals_per_cell() const {
  return static_cast<std::size_t>(shape_.rest_points) * shape_.reals;
}

}  // namespace tissu
