#pragma once

/// Edits the cells of a model in place: only the chunks in which cells come, go or get other nodes are laid
/// anew. What comes out is what the model of the edited block is, bit for bit.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/cell/chunk_edit.h"
#include "tissu/model/cell_edit.h"
#include "tissu/model/cell_model.h"

namespace tissu {

class CellEditor {
 public:
  /// Of a model of volume cells that were laid by a plan; it outlives the editor.
  explicit CellEditor(CellModel& model);

  [[nodiscard]] bool has(std::int32_t cell) const { return table_.has(cell); }
  [[nodiscard]] std::size_t cells() const { return model_.block_.cell_numbers.size(); }
  /// Of a cell, in the world.
  [[nodiscard]] std::span<const std::int32_t> nodes(std::int32_t cell) const;
  /// Cells and their rest shapes. Nodes of the edit are shifted by `first_node`; X are those of the world.
  void edit(const CellEdit& edit, std::int32_t first_node, ConstReals X);
  /// After the pattern has followed: the places in the matrix of the chunks that were laid, and of cells
  /// whose rows changed; cells of other models are passed over.
  void bind(const Sparsity& pattern, std::span<const std::int32_t> cells);
  /// The nodes of the chunks that the latest edit laid: those whose masses may differ. Not sorted.
  [[nodiscard]] std::vector<std::int32_t> laid_nodes() const;
  /// Adds what cells of the model, which all have the node, give to its mass and its weight [kg].
  void add_node(std::int32_t node, std::span<const std::int32_t> cells, double& mass, double& weight) const;

  /// Material of a cell at rest [m3].
  [[nodiscard]] double volume(std::int32_t cell) const;
  /// Elastic energy of some cells at x [J]; those of other models are passed over.
  [[nodiscard]] double energy(std::span<const std::int32_t> cells, ConstReals x);

 private:
  [[nodiscard]] std::int32_t origin(std::int32_t place) const {
    return model_.block_.origins[static_cast<std::size_t>(place)];
  }
  void lay_constants();
  void bind_lane(const Sparsity& pattern, std::int32_t lane);

  CellModel& model_;
  BlockTable table_;
  ChunkEdit chunks_;
  std::vector<std::int32_t> lane_;  ///< of the cell at each place of the block
  std::vector<ElementOrder::Run> laid_;
  std::vector<double> energies_;  ///< of each lane, while they are summed
};

}  // namespace tissu
