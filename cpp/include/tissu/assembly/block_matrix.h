#pragma once

/// The system matrix: 3x3 blocks in compressed rows. What is coupled only at run time (contact, links) stands
/// beside it (couplings.h), so that it never changes the pattern.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/assembly/couplings.h"
#include "tissu/assembly/linear_operator.h"
#include "tissu/assembly/sparsity.h"
#include "tissu/base/array.h"
#include "tissu/base/isa.h"

namespace tissu {

class BlockMatrix final : public LinearOperator {
 public:
  BlockMatrix(const Sparsity& sparsity, Isa isa, Threads threads);

  [[nodiscard]] const Sparsity& sparsity() const { return *sparsity_; }
  [[nodiscard]] std::int32_t rows() const override { return sparsity_->rows(); }
  /// [slot][9], column by column; asking for them to write counts as a change.
  [[nodiscard]] double* values() {
    count_change();
    return values_.data();
  }
  [[nodiscard]] const double* values() const { return values_.data(); }
  [[nodiscard]] std::int64_t diagonal_slot(std::int32_t row) const {
    return diagonal_[static_cast<std::size_t>(row)];
  }
  /// Follows its pattern, of which some rows have other columns or stand elsewhere. It has another id then.
  void follow_pattern(std::span<const std::int32_t> rows);
  /// All values zero, couplings gone, a new version.
  void clear();
  /// Adds to a block; refuses one that is not in the pattern.
  void add(std::int32_t row, std::int32_t column, const Mat3& block);
  /// Adds to the diagonal of one diagonal block.
  void add_diagonal(std::int32_t row, double value);
  /// out = (A + C) p, C the couplings
  void multiply(ConstReals p, Reals out) const override;
  void diagonal_blocks(Reals blocks) const override;
  [[nodiscard]] double diagonal_cost() const override { return 0.0; }
  [[nodiscard]] double round_off(ConstReals x) const override;
  [[nodiscard]] const BlockMatrix* matrix() const override { return this; }
  /// On the diagonal of A, without the couplings.
  [[nodiscard]] Mat3 diagonal_block(std::int32_t row) const;
  /// Makes rows and columns of the degrees of freedom in `masks` (bits x=1 y=2 z=4 for each row) those of the
  /// identity; `rows` are the rows with a mask. Both must outlive the next `clear`.
  void constrain(const std::vector<std::int32_t>& rows, const std::vector<std::uint8_t>& masks);

  [[nodiscard]] const Threads& threads() const override { return threads_; }
  [[nodiscard]] Isa isa() const { return isa_; }
  [[nodiscard]] std::size_t bytes() const override;

 private:
  const Sparsity* sparsity_;
  Isa isa_;
  Threads threads_;
  AlignedVector<double> values_;
  std::vector<std::int64_t> diagonal_;
  void (*multiply_rows_)(const std::int64_t* row_begin, const std::int64_t* row_end,
                         const std::int32_t* column, const double* values, std::int32_t begin,
                         std::int32_t end, const double* p, double* out);
};

}  // namespace tissu
