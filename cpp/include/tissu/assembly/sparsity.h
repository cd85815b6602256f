#pragma once

/// Which 3x3 blocks of a matrix may be non-zero: fixed while the topology is.

#include <cstdint>
#include <span>
#include <vector>

namespace tissu {

/// Compressed rows of 3x3 blocks; columns ascend in each row and every diagonal block is there. A row of a
/// closed pattern ends where the next one begins; a row of an open pattern ends before that, with room for
/// more blocks, and stands behind all others once it has outgrown its room.
struct Sparsity {
  std::vector<std::int64_t> row_begin;  ///< rows + 1
  std::vector<std::int32_t> column;
  std::vector<std::int64_t> open_end;  ///< of each row of an open pattern; empty: the pattern is closed
  std::vector<std::int64_t> room_end;  ///< where the room of each row of an open pattern ends

  [[nodiscard]] std::int32_t rows() const { return static_cast<std::int32_t>(row_begin.size()) - 1; }
  /// Places for blocks, those in the room of an open pattern included.
  [[nodiscard]] std::int64_t blocks() const { return row_begin.back(); }
  /// Where each row ends.
  [[nodiscard]] const std::int64_t* row_end() const {
    return open_end.empty() ? row_begin.data() + 1 : open_end.data();
  }
  [[nodiscard]] std::int64_t begin_of(std::int32_t row) const {
    return row_begin[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] std::int64_t end_of(std::int32_t row) const { return row_end()[row]; }
  /// Number of the block (row, column), -1 when it is not in the pattern.
  [[nodiscard]] std::int32_t slot(std::int32_t row, std::int32_t column) const;
  /// Gives a row of an open pattern other columns, ascending, its own among them: in its room, or behind all
  /// others with new room.
  void set_row(std::int32_t row, std::span<const std::int32_t> columns);
};

/// Gathers which nodes are coupled with which.
class SparsityBuilder {
 public:
  explicit SparsityBuilder(std::int32_t rows) : rows_(rows) {}
  /// Every node of a cell is coupled with every other: `nodes` holds cell after cell of `size` nodes.
  void add_cells(std::span<const std::int32_t> nodes, int size);
  /// `room`: spare blocks of each row, as a share of those that it has, rounded up. 0: a closed pattern.
  [[nodiscard]] Sparsity build(double room = 0.0) const;

 private:
  struct Cells {
    std::vector<std::int32_t> nodes;
    int size;
  };
  std::int32_t rows_;
  std::vector<Cells> cells_;
};

}  // namespace tissu
