#include "tissu/assembly/block_matrix.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/product_list.h"

namespace tissu {
namespace {

void clear_masked(double* block, unsigned row_mask, unsigned column_mask) {
  for (unsigned c = 0; c < 3; ++c) {
    for (unsigned r = 0; r < 3; ++r) {
      if (((row_mask >> r) & 1U) != 0 || ((column_mask >> c) & 1U) != 0) block[3 * c + r] = 0.0;
    }
  }
}

}  // namespace

BlockMatrix::BlockMatrix(const Sparsity& sparsity, Isa isa, Threads threads)
    : sparsity_(&sparsity), isa_(isa), threads_(threads), multiply_rows_(multiply_rows_of<double>(isa)) {
  // One number more than needed: a register of four read at the last column of the last block stays inside.
  values_.assign(static_cast<std::size_t>(9 * sparsity.blocks() + 1), 0.0);
  diagonal_.reserve(static_cast<std::size_t>(sparsity.rows()));
  for (std::int32_t r = 0; r < sparsity.rows(); ++r) diagonal_.push_back(sparsity.slot(r, r));
}

void BlockMatrix::clear() {
  const auto rows = static_cast<std::int32_t>(values_.size() / 64 + 1);
  threads_.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) {
    const auto size = static_cast<std::int64_t>(values_.size());
    std::fill(values_.begin() + std::min<std::int64_t>(size, std::int64_t{64} * begin),
              values_.begin() + std::min<std::int64_t>(size, std::int64_t{64} * end), 0.0);
  });
  extra_.clear();
  set_given(nullptr);
  count_change();
}

bool BlockMatrix::add_to_extra(std::int32_t row, std::int32_t column, const Mat3& block) {
  for (ExtraBlock& e : extra_) {
    if (e.row == row && e.column == column) {
      for (std::size_t i = 0; i < 9; ++i) e.values[i] += block.data()[i];
      return true;
    }
  }
  return false;
}

void BlockMatrix::add(std::int32_t row, std::int32_t column, const Mat3& block) {
  count_change();
  const std::int32_t slot = sparsity_->slot(row, column);
  if (slot >= 0) {
    double* to = values_.data() + 9 * static_cast<std::ptrdiff_t>(slot);
    for (int i = 0; i < 9; ++i) to[i] += block.data()[i];
    return;
  }
  if (add_to_extra(row, column, block)) return;
  ExtraBlock e{row, column, {}};
  std::copy_n(block.data(), 9, e.values.begin());
  extra_.push_back(e);
}

void BlockMatrix::add_diagonal(std::int32_t row, double value) {
  count_change();
  double* to = values_.data() + 9 * diagonal_slot(row);
  to[0] += value;
  to[4] += value;
  to[8] += value;
}

void BlockMatrix::multiply(ConstReals p, Reals out) const {
  threads_.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows_(sparsity_->row_begin.data(), sparsity_->column.data(), values_.data(), begin, end,
                   p.data(), out.data());
  });
  for (const ExtraBlock& e : extra_) {
    block(out, e.row) += Eigen::Map<const Mat3>(e.values.data()) * block(p, e.column);
  }
}

void BlockMatrix::diagonal_blocks(Reals blocks) const {
  for (std::int32_t i = 0; i < rows(); ++i) {
    std::copy_n(values_.data() + 9 * diagonal_slot(i), 9, blocks.data() + 9 * static_cast<std::ptrdiff_t>(i));
  }
}

double BlockMatrix::round_off(ConstReals x) const {
  double sum = 0.0;
  for (std::int32_t i = 0; i < rows(); ++i) {
    sum += diagonal_block(i).diagonal().cwiseProduct(block(x, i)).squaredNorm();
  }
  return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

Mat3 BlockMatrix::diagonal_block(std::int32_t row) const {
  return Eigen::Map<const Mat3>(values_.data() + 9 * diagonal_slot(row));
}

void BlockMatrix::constrain(const std::vector<std::int32_t>& rows, const std::vector<std::uint8_t>& masks) {
  count_change();
  set_given(&masks);
  for (const std::int32_t r : rows) {
    const unsigned mask = masks[static_cast<std::size_t>(r)];
    for (auto s = sparsity_->row_begin[static_cast<std::size_t>(r)];
         s < sparsity_->row_begin[static_cast<std::size_t>(r) + 1]; ++s) {
      const std::int32_t c = sparsity_->column[static_cast<std::size_t>(s)];
      clear_masked(values_.data() + 9 * s, mask, 0);
      clear_masked(values_.data() + 9 * static_cast<std::int64_t>(sparsity_->slot(c, r)), 0, mask);
    }
    double* diagonal = values_.data() + 9 * diagonal_slot(r);
    for (unsigned i = 0; i < 3; ++i) {
      if (((mask >> i) & 1U) != 0) diagonal[4 * i] = 1.0;
    }
  }
  for (ExtraBlock& e : extra_) {
    clear_masked(e.values.data(), masks[static_cast<std::size_t>(e.row)],
                 masks[static_cast<std::size_t>(e.column)]);
  }
}

std::size_t BlockMatrix::bytes() const {
  return values_.size() * sizeof(double) + sparsity_->column.size() * sizeof(std::int32_t) +
         sparsity_->row_begin.size() * sizeof(std::int64_t) + diagonal_.size() * sizeof(std::int64_t);
}

}  // namespace tissu
