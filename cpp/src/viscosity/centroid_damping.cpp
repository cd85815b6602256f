#include "tissu/viscosity/centroid_damping.h"

#include <algorithm>
#include <limits>

namespace tissu {

CentroidDamping::CentroidDamping(const std::vector<const BodyModel*>& models, double coefficient,
                                 Threads threads)
    : threads_(threads) {
  first_node_ = std::numeric_limits<std::int32_t>::max();
  std::int32_t last = 0;
  for (const BodyModel* model : models) {
    const auto [low, high] = std::ranges::minmax(model->block().cells);
    first_node_ = std::min(first_node_, low);
    last = std::max(last, high);
  }
  SparsityBuilder builder(last + 1 - first_node_);
  for (const BodyModel* model : models) {
    Cells cells{model->block().cells, model->nodes_per_cell()};
    for (std::int32_t& node : cells.nodes) node -= first_node_;
    builder.add_cells(cells.nodes, cells.size);
    cells_.push_back(std::move(cells));
  }
  own_ = builder.build();
  dampers_.assign(static_cast<std::size_t>(own_.blocks()), 0.0);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const std::vector<double>& volumes = models[m]->volumes();
    const auto n = static_cast<std::size_t>(cells_[m].size);
    for (std::size_t e = 0; e < volumes.size(); ++e) {
      const std::int32_t* cell = cells_[m].nodes.data() + e * n;
      const double damper = coefficient * volumes[e] / static_cast<double>(n);
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
          if (a != b) dampers_[static_cast<std::size_t>(own_.slot(cell[a], cell[b]))] += damper;
        }
      }
    }
  }
}

void CentroidDamping::couple(SparsityBuilder& builder) const {
  for (const Cells& cells : cells_) {
    std::vector<std::int32_t> nodes = cells.nodes;
    for (std::int32_t& node : nodes) node += first_node_;
    builder.add_cells(nodes, cells.size);
  }
}

template <class Function>
void CentroidDamping::for_entries(std::int32_t begin, std::int32_t end, Function&& f) const {
  for (std::int32_t row = begin; row < end; ++row) {
    const auto first = static_cast<std::size_t>(own_.begin_of(row));
    const auto last = static_cast<std::size_t>(own_.end_of(row));
    for (std::size_t entry = first; entry < last; ++entry) {
      f(first_node_ + row, first_node_ + own_.column[entry], entry);
    }
  }
}

void CentroidDamping::bind(const Sparsity& pattern) {
  slots_.resize(dampers_.size());
  threads_.for_pieces(own_.rows(), [&](std::int32_t begin, std::int32_t end) {
    for_entries(begin, end, [&](std::int32_t row, std::int32_t column, std::size_t entry) {
      slots_[entry] = pattern.slot(row, column);
    });
  });
}

void CentroidDamping::add_force(const State& state, Scratch& scratch, Reals f) const {
  add_product(state, scratch, {0.0, 1.0}, state.velocities, f);
}

void CentroidDamping::add_product(const State& /*state*/, Scratch& /*scratch*/, StiffnessScale scale,
                                  ConstReals p, Reals out) const {
  if (scale.velocity == 0.0) return;
  threads_.for_pieces(own_.rows(), [&](std::int32_t begin, std::int32_t end) {
    for_entries(begin, end, [&](std::int32_t row, std::int32_t column, std::size_t entry) {
      const double c = scale.velocity * dampers_[entry];
      const auto i = static_cast<std::size_t>(3 * row);
      const auto j = static_cast<std::size_t>(3 * column);
      for (std::size_t k = 0; k < 3; ++k) out[i + k] += c * (p[j + k] - p[i + k]);
    });
  });
}

void CentroidDamping::add_stiffness(const State& /*state*/, Scratch& /*scratch*/, StiffnessScale scale,
                                    BlockMatrix& matrix) const {
  if (scale.velocity == 0.0) return;
  double* values = matrix.values();
  threads_.for_pieces(own_.rows(), [&](std::int32_t begin, std::int32_t end) {
    for_entries(begin, end, [&](std::int32_t row, std::int32_t /*column*/, std::size_t entry) {
      const double c = scale.velocity * dampers_[entry];
      double* block = values + 9 * static_cast<std::ptrdiff_t>(slots_[entry]);
      double* diagonal = values + 9 * static_cast<std::ptrdiff_t>(matrix.diagonal_slot(row));
      for (std::ptrdiff_t k = 0; k < 9; k += 4) {
        block[k] += c;
        diagonal[k] -= c;
      }
    });
  });
}

}  // namespace tissu
