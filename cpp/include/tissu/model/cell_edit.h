#pragma once

/// What an edit does to the cells of a body or a block.

#include <cstdint>
#include <vector>

#include "tissu/model/elastic_block.h"

namespace tissu {

struct CellEdit {
  struct Cell {
    std::int32_t number = 0;          ///< in the body
    std::int32_t parent = 0;          ///< the cell, of those that go, that it takes everything from
    double share = 1.0;               ///< how much of the parent's whole volume is its material
    std::vector<std::int32_t> nodes;  ///< in the parent's order
  };
  /// A cell that stays, whose nodes part from those of its neighbours.
  struct Moved {
    std::int32_t number = 0;
    std::vector<std::int32_t> nodes;
  };
  std::vector<std::int32_t> gone;  ///< cells, ascending
  std::vector<Cell> born;          ///< ascending in their numbers
  std::vector<Moved> moved;        ///< ascending
};

/// Where each cell of a block stands while cells come and go in place: the first that is born of a cell takes
/// its place, others follow the last, and the last cells fill the places that are left.
class BlockTable {
 public:
  /// Makes numbers, origins and shares of the block one for each cell.
  explicit BlockTable(ElasticBlock& block);

  [[nodiscard]] bool has(std::int32_t number) const {
    return static_cast<std::size_t>(number) < place_.size() && place_[static_cast<std::size_t>(number)] >= 0;
  }
  /// By number; -1: not in this block.
  [[nodiscard]] const std::vector<std::int32_t>& places() const { return place_; }
  [[nodiscard]] std::int32_t place(std::int32_t number) const {
    return place_[static_cast<std::size_t>(number)];
  }

  /// A cell that was moved within the block.
  struct Shift {
    std::int32_t from;
    std::int32_t to;
    std::int32_t origin;  ///< the cell of the first day that it comes from
  };
  /// Edits the block by its share of an edit, whose nodes are shifted by `first_node`.
  std::vector<Shift> apply(const CellEdit& edit, std::int32_t first_node, ElasticBlock& block);

 private:
  void bear(const CellEdit& edit, std::int32_t first_node, ElasticBlock& block);
  void set(const CellEdit::Cell& cell, std::int32_t place, std::int32_t first_node, ElasticBlock& block);

  std::size_t nodes_;
  std::vector<std::int32_t> place_;
};

}  // namespace tissu
