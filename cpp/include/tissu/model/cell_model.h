#pragma once

/// What all models on cells share: cells in groups of eight lanes, their rest shape, masses, places in the
/// matrix, and the loop over the chunks.

#include "tissu/base/array.h"
#include "tissu/base/parallel.h"
#include "tissu/element/reference_cell.h"
#include "tissu/model/body_model.h"
#include "tissu/model/element_order.h"
#include "tissu/model/rest_shape.h"

namespace tissu {

class CellModel : public BodyModel {
 public:
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;

  [[nodiscard]] const ElasticBlock& block() const override { return block_; }
  [[nodiscard]] std::int32_t cell_count() const override;
  [[nodiscard]] int nodes_per_cell() const override { return reference_.nodes; }
  [[nodiscard]] const std::vector<double>& volumes() const override { return shape_.volumes; }
  void add_masses(std::vector<double>& nodal) const override;
  void add_weights(std::vector<double>& nodal) const override;
  /// Node and matrix places.
  [[nodiscard]] std::size_t bytes() const override;

 protected:
  static constexpr std::size_t kLanes = ElementOrder::kLanes;

  /// Refuses unknown elements and quadratures, parts of cells, and densities, thicknesses or sections that
  /// are not positive.
  CellModel(ElasticBlock block, Threads threads);
  /// Gives the cells their order and rest shape; refuses cells that are inverted or have no volume.
  /// Cells of one number in `together` stand in one chunk (element_order.h).
  void lay_cells(ConstReals rest_positions, RestForm form, std::span<const std::int32_t> together = {});

  /// Keeps of the rest shape only the volumes: for models that have constants of their own.
  void keep_volumes();
  /// Places in the matrix of the pairs of nodes of each lane, [group][a][b][8]; `cells` have `size` nodes.
  void lay_slots(const ElementOrder& order, const std::vector<std::int32_t>& cells, int size,
                 const Sparsity& pattern, AlignedVector<std::int32_t>& slots) const;

  /// Calls f(chunk) for every chunk; those that run at the same time share no node.
  template <class Function>
  void for_chunks(Function&& f) const {
    for_chunks(order_, f);
  }
  template <class Function>
  void for_chunks(const ElementOrder& order, Function&& f) const {
    for (std::int32_t colour = 0; colour < order.colours(); ++colour) {
      const std::int32_t begin = order.colour_begin[static_cast<std::size_t>(colour)];
      const std::int32_t end = order.colour_begin[static_cast<std::size_t>(colour) + 1];
      threads_.for_each(end - begin,
                        [&](std::int32_t c) { f(order.chunks[static_cast<std::size_t>(begin + c)]); });
    }
  }
  /// Calls f(lane number, cell) for every lane that is not only there to pad: group = number / kLanes.
  template <class Function>
  void for_lanes(Function&& f) const {
    for (std::size_t i = 0; i < order_.element.size(); ++i) {
      if (order_.real[i] != 0) f(i, static_cast<std::size_t>(order_.element[i]));
    }
  }

  ElasticBlock block_;
  Threads threads_;
  ReferenceCell reference_;
  ElementOrder order_;
  RestShape shape_;
  AlignedVector<std::int32_t> slots_;  ///< [group][a][b][8], blocks of the matrix

 private:
  template <class Function>
  void for_nodes(Function&& f) const;
};

/// Von Mises' stress of each lane's mean Cauchy stress xx yy zz yz xz xy, [group][6][8].
double von_mises(const double* stresses, std::size_t lane);

}  // namespace tissu
