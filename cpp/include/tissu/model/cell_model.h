#pragma once

/// What all models on cells share: cells in groups of eight lanes, their rest shape, masses, places in the
/// matrix, and the loops over the chunks.

#include <algorithm>
#include <numeric>
#include <utility>

#include "tissu/base/array.h"
#include "tissu/base/parallel.h"
#include "tissu/cell/elastic_kernels.h"
#include "tissu/cell/element_order.h"
#include "tissu/cell/rest_shape.h"
#include "tissu/element/reference_cell.h"
#include "tissu/model/body_model.h"
#include "tissu/model/law_constants.h"

namespace tissu {

/// What the loops of a model run with: its kernels, what these read, and the order of the chunks.
template <class Kernels, class View>
struct Loops {
  const Kernels& kernels;
  View view;
  const ElementOrder& order;
};

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
  /// Of a model that is edited in place: adds the energy of each lane of a chunk [J], [group][8] of all.
  virtual void add_energies(const Chunk& /*chunk*/, ConstReals /*x*/, Reals /*lanes*/) const {}

 protected:
  static constexpr std::size_t kLanes = ElementOrder::kLanes;

  /// Refuses unknown elements and quadratures, parts of cells, and densities, thicknesses or sections that
  /// are not positive.
  CellModel(ElasticBlock block, Threads threads);
  /// Gives the cells their order and rest shape; refuses cells that are inverted or have no volume.
  /// Cells of one number in `together` stand in one chunk (element_order.h).
  void lay_cells(ConstReals rest_positions, RestForm form, std::span<const std::int32_t> together = {});
  /// The same for numbered cells that may be edited in place: their order is that of the first day's plan
  /// (chunk_plan.h), which they make if this is the first day.
  void lay_planned_cells(ConstReals rest_positions, RestForm form);

  /// Keeps of the rest shape only the volumes: for models that have constants of their own.
  void keep_volumes();
  /// Places in the matrix of the pairs of nodes of each lane, [group][a][b][8]; `cells` have `size` nodes.
  void lay_slots(const ElementOrder& order, const std::vector<std::int32_t>& cells, int size,
                 const Sparsity& pattern, AlignedVector<std::int32_t>& slots) const;
  /// Lays `count` constants of each lane, which of_lane(lane number, constants) writes, as kernels read them;
  /// of one group only, when its constants serve all cells.
  template <class Function>
  void lay_constants(std::size_t count, bool uniform, Function&& of_lane) {
    const auto groups = uniform ? std::size_t{1} : static_cast<std::size_t>(order_.groups());
    constants_stride_ = uniform ? 0 : static_cast<std::ptrdiff_t>(count * kLanes);
    constants_.resize(groups * count * kLanes);
    std::vector<double> constants(count);
    for (std::size_t i = 0; i < groups * kLanes; ++i) {
      of_lane(i, std::span<double>(constants));
      for (std::size_t c = 0; c < count; ++c)
        constants_[(i / kLanes * count + c) * kLanes + i % kLanes] = constants[c];
    }
  }
  void take_constants(LawConstants laid) {
    constants_ = std::move(laid.values);
    constants_stride_ = laid.stride;
  }
  /// dN_a/dxi, [point][node][m]: what ElasticView::gradients reads.
  [[nodiscard]] std::vector<double> reference_gradients() const;
  /// The cells as kernels read them, without gradients, frames and laws.
  [[nodiscard]] ElasticView cell_view() const;

  // The verbs of a model, each a loop over the chunks. Those that run at the same time share no node.
  template <class L>
  void force_by(const L& loops, ConstReals x, Reals f) const {
    for_chunks(loops.order,
               [&](const Chunk& chunk) { loops.kernels.force(loops.view, chunk, x.data(), f.data()); });
  }
  /// out += scale * (df/dx) p
  template <class L>
  void product_by(const L& loops, ConstReals x, double scale, ConstReals p, Reals out) const {
    if (scale == 0.0) return;
    for_chunks(loops.order, [&](const Chunk& chunk) {
      loops.kernels.product(loops.view, chunk, x.data(), scale, p.data(), out.data());
    });
  }
  /// matrix += scale.position * df/dx, made definite where that is asked for and need be.
  template <class L>
  void stiffness_by(const L& loops, ConstReals x, StiffnessScale scale, BlockMatrix& matrix) const {
    if (scale.position == 0.0) return;
    auto loop = loops.kernels.stiffness;
    if constexpr (requires { loops.kernels.definite; }) {
      if (scale.definite && loops.kernels.definite != nullptr) loop = loops.kernels.definite;
    }
    double* blocks = matrix.values();
    for_chunks(loops.order,
               [&](const Chunk& chunk) { loop(loops.view, chunk, x.data(), scale.position, blocks); });
  }
  /// Of each lane [J]; valid until the scratch is used again.
  template <class L>
  [[nodiscard]] ConstReals energies_by(const L& loops, ConstReals x, Scratch& scratch) const {
    const Reals energies = scratch.reals(loops.order.element.size());
    std::ranges::fill(energies, 0.0);
    for_chunks(loops.order, [&](const Chunk& chunk) {
      loops.kernels.energy(loops.view, chunk, x.data(), energies.data());
    });
    return energies;
  }
  template <class L>
  [[nodiscard]] double energy_by(const L& loops, ConstReals x, Scratch& scratch) const {
    const ConstReals energies = energies_by(loops, x, scratch);
    if (loops.order.runs.empty()) return std::accumulate(energies.begin(), energies.end(), 0.0);
    double sum = 0.0;
    for (const ElementOrder::Run run : loops.order.runs)
      sum = std::accumulate(energies.begin() + run.begin * ElementOrder::kLanes,
                            energies.begin() + run.end * ElementOrder::kLanes, sum);
    return sum;
  }
  /// `volume_ratio` holds what the kernels write beside their stresses.
  template <class L>
  [[nodiscard]] CellFields fields_by(const L& loops, ConstReals x) const {
    std::vector<double> stresses(6 * loops.order.element.size());
    std::vector<double> ratios(loops.order.element.size());
    for_chunks(loops.order, [&](const Chunk& chunk) {
      loops.kernels.stress(loops.view, chunk, x.data(), stresses.data(), ratios.data());
    });
    Scratch scratch;
    return cell_fields(stresses, ratios, energies_by(loops, x, scratch));
  }

  /// Calls f(chunk) for every chunk; those that run at the same time share no node.
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
  AlignedVector<double> constants_;    ///< [group or one][constant][8]
  std::ptrdiff_t constants_stride_ = 0;

 private:
  friend class CellEditor;
  void lay_rest_shape(ConstReals rest_positions, RestForm form);
  [[nodiscard]] CellFields cell_fields(const std::vector<double>& stresses, const std::vector<double>& ratios,
                                       ConstReals energies) const;
  template <class Function>
  void for_nodes(Function&& f) const;
  /// For the nodes of one lane.
  template <class Function>
  void for_lane_nodes(std::size_t i, std::vector<double>& scratch, Function&& f) const {
    const auto nodes = static_cast<std::size_t>(reference_.nodes);
    const auto rest_points = static_cast<std::size_t>(shape_.rest_points);
    const std::size_t rest = shape_.reals;
    const auto e = static_cast<std::size_t>(order_.element[i]);
    const double density = of_cell(block_.density, order_.element[i]);
    scratch.assign(2 * nodes, 0.0);
    double* first = scratch.data();
    double* second = first + nodes;
    double squares = 0.0;
    for (std::size_t g = 0; g < reference_.points.size(); ++g) {
      const std::size_t at = i / kLanes * rest_points + (rest_points == 1 ? 0 : g);
      const double w = shape_.rest[(at * rest + rest - 1) * kLanes + i % kLanes] * shape_.weights[g];
      for (std::size_t a = 0; a < nodes; ++a) {
        const double N = reference_.points[g].values[a];
        first[a] += w * density * N;
        second[a] += w * N * N;
        squares += w * N * N;
      }
    }
    for (std::size_t a = 0; a < nodes; ++a) {
      const auto node = static_cast<std::size_t>(block_.cells[e * nodes + a]);
      f(node, density * shape_.volumes[e], first[a], second[a] / squares);
    }
  }
};

}  // namespace tissu
