#pragma once

/// The blocks below the diagonal of a symmetric block matrix, by rows, and the order in which rows of
/// triangular solves may run.

#include <cstdint>
#include <vector>

#include "tissu/assembly/block_matrix.h"

namespace tissu {

/// Rows that may run at the same time, one group after the other: each row needs rows of earlier groups only.
/// The bits do not depend on it, because a row adds up in the order of its columns.
struct RowGroups {
  std::vector<std::int32_t> rows;
  std::vector<std::int32_t> begin;  ///< of each group in `rows`, and the end
  bool one_by_one = true;           ///< one group, whose rows need each other in their order

  /// f(pointer to rows, count), groups in order, the rows of a group on all threads.
  template <class Function>
  void for_rows(const Threads& threads, Function&& f) const {
    for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
      const std::int32_t first = begin[g];
      const std::int32_t count = begin[g + 1] - first;
      const std::int32_t piece = one_by_one ? count : kPiece;
      threads.for_each((count + piece - 1) / piece, [&](std::int32_t p) {
        f(rows.data() + first + p * piece, std::min(piece, count - p * piece));
      });
    }
  }
  static constexpr std::int32_t kPiece = 64;
};

class BlockTriangle {
 public:
  /// Blocks (row, column < row); columns ascend in each row.
  std::vector<std::int64_t> lower_begin;
  std::vector<std::int32_t> lower_column;
  /// The same blocks by their columns, that is the rows of the transpose.
  std::vector<std::int64_t> upper_begin;
  std::vector<std::int32_t> upper_column;
  std::vector<std::int64_t> upper_place;  ///< number of the block in the lower triangle
  RowGroups forward;
  RowGroups backward;

  /// Takes over the pattern; nothing is done when it is there already.
  void update(const BlockMatrix& matrix);
  /// The values of block number `b`, of which every row has the ones that `lower_begin` says.
  [[nodiscard]] const double* values(const BlockMatrix& matrix, std::int64_t b) const {
    return matrix.values() + 9 * source_[static_cast<std::size_t>(b)];
  }
  [[nodiscard]] std::int64_t blocks() const { return lower_begin.empty() ? 0 : lower_begin.back(); }
  /// Pairs of blocks (i, k), (j, k) with a block (i, j): what an incomplete factor multiplies.
  [[nodiscard]] std::int64_t pairs() const { return pairs_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  void gather(const BlockMatrix& matrix);
  void transpose();
  void count_pairs();

  std::vector<std::int64_t> source_;  ///< slot of each block
  std::uint64_t matrix_ = 0;
  std::int64_t pairs_ = 0;
};

}  // namespace tissu
