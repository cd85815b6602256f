#pragma once

/// From the rows of a level to those of the next coarser one, and its matrix.

#include "aggregates.h"
#include "block_rows.h"

namespace tissu {

/// Who depends on whom, made once for a pattern. Columns of `prolongation` and `product` are aggregates.
struct CoarsePattern {
  RowPattern prolongation;          ///< of P
  RowPattern product;               ///< of A P
  RowPattern restriction;           ///< of P^T, the same for both rows of an aggregate; columns are fine rows
  std::vector<std::int64_t> place;  ///< of a block of the restriction, in the prolongation
  RowPattern matrix;                ///< of P^T A P, by aggregates
  std::int64_t pairs = 0;           ///< products of a block with a motion that P^T A P takes

  CoarsePattern(const LevelMatrix& A, const Aggregates& aggregates);
  [[nodiscard]] std::size_t bytes() const;
};

/// Both columns or rows of an aggregate, one after the other.
RowPattern twice_columns(const RowPattern& pattern);
RowPattern twice_rows(const RowPattern& pattern);
RowPattern twice(const RowPattern& pattern);

/// Smoothed aggregation: P = (1 - w D^-1 A) P0, where P0 moves the rows of each aggregate as a rigid body, a
/// point at x by t + r x (x - c) and a rotation by r, but not the axes that are given. `inverse`: the inverse
/// diagonal blocks of A.
template <class T>
void fill_prolongation(const LevelMatrix& A, const Aggregates& aggregates, const RowPlaces& fine,
                       const RowPlaces& coarse, const T* inverse, double w, const CoarsePattern& pattern,
                       const Threads& threads, BlockRows<T>& P);

/// P^T in the rows of the aggregates.
template <class T>
void fill_restriction(const CoarsePattern& pattern, const BlockRows<T>& P, const Threads& threads,
                      BlockRows<T>& R);

/// What `fill_coarse_matrix` works with: A P of some rows at a time, and how far each aggregate has come.
struct CoarseScratch {
  AlignedVector<double> product;
  std::vector<std::int64_t> next;

  [[nodiscard]] std::size_t bytes() const {
    return product.size() * sizeof(double) + next.size() * sizeof(std::int64_t);
  }
};

/// P^T A P, block by block, in parts: of the rows [from, from + rows) of A, the first of all from 0 on.
/// Returns where the next part begins, 0 after the last. A may change between parts: what they make is
/// symmetric all the same. Motions that no row takes part in get a diagonal.
template <class T>
std::int32_t fill_coarse_part(const LevelMatrix& A, const CoarsePattern& pattern, const BlockRows<T>& P,
                              std::int32_t from, std::int32_t rows, const Threads& threads,
                              CoarseScratch& scratch, AlignedVector<double>& values);

/// All of it at once.
template <class T>
void fill_coarse_matrix(const LevelMatrix& A, const CoarsePattern& pattern, const BlockRows<T>& P,
                        const Threads& threads, CoarseScratch& scratch, AlignedVector<double>& values) {
  fill_coarse_part(A, pattern, P, 0, A.rows(), threads, scratch, values);
}

}  // namespace tissu
