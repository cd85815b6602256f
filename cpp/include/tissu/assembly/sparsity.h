#pragma once

/// Which 3x3 blocks of a matrix may be non-zero: fixed while the topology is.

#include <cstdint>
#include <span>
#include <vector>

namespace tissu {

/// Compressed rows of 3x3 blocks; columns ascend in each row and every diagonal block is there.
struct Sparsity {
  std::vector<std::int64_t> row_begin;  ///< rows + 1
  std::vector<std::int32_t> column;

  [[nodiscard]] std::int32_t rows() const { return static_cast<std::int32_t>(row_begin.size()) - 1; }
  [[nodiscard]] std::int64_t blocks() const { return row_begin.back(); }
  /// Number of the block (row, column), -1 when it is not in the pattern.
  [[nodiscard]] std::int32_t slot(std::int32_t row, std::int32_t column) const;
};

/// Gathers who is coupled with whom.
class SparsityBuilder {
 public:
  explicit SparsityBuilder(std::int32_t rows) : rows_(rows) {}
  /// Every node of a cell is coupled with every other: `nodes` holds cell after cell of `size` nodes.
  void add_cells(std::span<const std::int32_t> nodes, int size);
  [[nodiscard]] Sparsity build() const;

 private:
  struct Cells {
    std::vector<std::int32_t> nodes;
    int size;
  };
  std::int32_t rows_;
  std::vector<Cells> cells_;
};

}  // namespace tissu
