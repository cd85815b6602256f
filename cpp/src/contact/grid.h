#pragma once

/// Space in equal cells; boxes that share a cell are tested. Cells are found by a hash table.

#include <array>

#include "contact/box_tree.h"
#include "contact/meetings.h"
#include "contact/pair_sort.h"

namespace tissu {

class GridBroadPhase final : public BroadPhase {
 public:
  explicit GridBroadPhase(const SearchPlan& plan);

  [[nodiscard]] std::string_view name() const override { return "grid"; }
  void find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) override;
  [[nodiscard]] std::size_t bytes() const override;

 private:
  /// A cell has sides of 1.5 times the mean of the boxes' longest sides, and at least so long that there are
  /// no more than 2^20 along an axis.
  struct Cells {
    std::array<double, 3> origin;
    double per_length;  ///< [1/m]
  };
  /// The cells of a box, first and last along each axis.
  struct Range {
    std::array<std::int32_t, 3> first;
    std::array<std::int32_t, 3> last;
  };
  /// A box in one of its cells.
  struct Entry {
    std::uint64_t cell;  ///< the three numbers of the cell, 21 bits each
    std::int32_t primitive;
    std::uint32_t at_first;  ///< bit k: along axis k the cell is the box's first one
  };
  [[nodiscard]] Cells cells(std::span<const Box> boxes) const;
  [[nodiscard]] static Range range(const Box& box, const Cells& cells);
  void sort_into_cells(std::span<const Box> boxes);
  void enter(const Range& range, std::int32_t primitive);
  void add_pairs_in_cells(std::span<const Box> boxes);
  void add_pairs_of_large(std::span<const Box> boxes);
  [[nodiscard]] std::size_t slot(std::uint64_t cell) const;

  Meetings meetings_;
  int slot_bits_;
  std::vector<std::int32_t> small_;  ///< primitives in at most 8 cells
  std::vector<std::int32_t> large_;  ///< the others
  std::vector<Range> ranges_;        ///< of each of `small_`
  std::vector<std::uint32_t> end_;   ///< of the entries of each slot of the table
  std::vector<Entry> entries_;       ///< slot by slot
  BoxTree tree_;                     ///< of `large_`
  FoundPairs found_;
  PairSort sort_;
};

}  // namespace tissu
