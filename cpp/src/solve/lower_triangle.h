#pragma once

/// The lower triangle of a symmetric block matrix in compressed columns, for libraries that factor such.

#include <cstdint>
#include <vector>

#include "tissu/assembly/block_matrix.h"

namespace tissu {

class LowerTriangle {
 public:
  std::vector<int> column_begin;
  std::vector<int> row;
  std::vector<double> values;

  /// Takes over the pattern, with that of the couplings if there are any; returns false when it is the one
  /// that is there already.
  bool update_pattern(const BlockMatrix& matrix, const Couplings* couplings);
  /// Takes over the values, and adds `shift` times the diagonal's size to the diagonal,
  /// save where a value is given.
  void update_values(const BlockMatrix& matrix, const Couplings* couplings, double shift);

 private:
  void add(const Couplings& couplings);
  /// One block on or right of the diagonal, in the order of rows: a slot, or -1 where the matrix has none.
  struct Source {
    std::int32_t row;
    std::int32_t column;
    std::int64_t place;
  };
  std::uint64_t matrix_ = 0;
  const Sparsity* sparsity_ = nullptr;
  std::vector<std::pair<std::int32_t, std::int32_t>> extra_;
  std::vector<Source> sources_;
  std::vector<std::int64_t> source_begin_;
};

}  // namespace tissu
