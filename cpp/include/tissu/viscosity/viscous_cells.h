#pragma once

/// A viscous force on a body's cells beside the model that carries them, whatever that model is: it keeps a
/// rest shape of its own, and neither masses nor fields are asked of it.

#include <vector>

#include "tissu/cell/elastic_kernels.h"
#include "tissu/law/law.h"
#include "tissu/model/cell_model.h"

namespace tissu {

class ViscousCells : public CellModel {
 public:
  [[nodiscard]] CellFields fields(const State& /*state*/) const final { return {}; }
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t reals_per_cell() const override;

 protected:
  ViscousCells(const ElasticBlock& block, ConstReals rest_positions, Threads threads);
  /// Without laws.
  [[nodiscard]] ElasticView view() const;

  std::vector<double> gradients_;  ///< [point][node][m]
};

}  // namespace tissu
