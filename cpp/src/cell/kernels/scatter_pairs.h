#pragma once

/// Element matrices, symmetric, into the matrix of the world: a block and its transpose at once.

#include "tissu/base/batch.h"
#include "tissu/law/tensor.h"

namespace tissu::TISSU_KERNELS {

/// Adds the block (a, b) and, when a != b, its transpose as (b, a). `block` is column by column.
template <int kNodes>
TISSU_INLINE void scatter_pair(const std::int32_t* slots, int a, int b, const Batch (&block)[9],
                               double* blocks) {
  scatter_add_block(blocks, slots + (a * kNodes + b) * kLanes, block);
  if (a == b) return;
  const Batch transposed[9] = {block[0], block[3], block[6], block[1], block[4],
                               block[7], block[2], block[5], block[8]};
  scatter_add_block(blocks, slots + (b * kNodes + a) * kLanes, transposed);
}

/// Asks for the blocks that the pairs of a batch of cells will be added to. What a chunk writes does not fit
/// the first-level cache, and the sums that follow would wait for one block after the other.
template <int kNodes>
TISSU_INLINE void fetch_pairs(const std::int32_t* slots, const double* blocks) {
  for (int pair = 0; pair < kNodes * kNodes; ++pair) {
    TISSU_UNROLL
    for (int lane = 0; lane < kWidth; ++lane) {
      const double* block = at(blocks, slots[pair * kLanes + lane], 9);
      __builtin_prefetch(block, 1);
      __builtin_prefetch(block + 8, 1);
    }
  }
}

/// Where the blocks of every row sum to zero, those of node 0 follow from the others: (0, b) = -sum_a (a, b).
/// `K` holds the pairs a <= b of the nodes 1, 2, … as [b (b - 1) / 2 + a - 1].
template <int kNodes>
TISSU_INLINE void scatter_first_node(const std::int32_t* slots,
                                     const Batch (&K)[kNodes * (kNodes - 1) / 2][9], double* blocks) {
  Batch corner[9];
  for (Batch& entry : corner) entry = Batch(0.0);
  for (int b = 1; b < kNodes; ++b) {
    Batch row[9];
    for (Batch& entry : row) entry = Batch(0.0);
    TISSU_UNROLL
    for (int a = 1; a < kNodes; ++a) {
      const int high = a < b ? b : a;
      const int low = a < b ? a : b;
      const Batch(&block)[9] = K[(high - 1) * high / 2 + low - 1];
      TISSU_UNROLL
      for (int c = 0; c < 9; ++c) row[c] -= a <= b ? block[c] : block[(c % 3) * 3 + c / 3];
    }
    TISSU_UNROLL
    for (int c = 0; c < 9; ++c) corner[c] -= row[c];
    scatter_pair<kNodes>(slots, 0, b, row, blocks);
  }
  scatter_pair<kNodes>(slots, 0, 0, corner, blocks);
}

}  // namespace tissu::TISSU_KERNELS
