#include "tissu/assembly/block_matrix.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/product_list.h"
#include "tissu/base/error.h"

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
  constexpr double kSpare = 1.25;  // rows of an open pattern that outgrow their room go behind the others
  if (!sparsity.open_end.empty())
    values_.reserve(static_cast<std::size_t>(kSpare * 9.0 * static_cast<double>(sparsity.blocks())));
  // One number more than needed: a register of four read at the last column of the last block stays inside.
  values_.assign(static_cast<std::size_t>(9 * sparsity.blocks() + 1), 0.0);
  diagonal_.reserve(static_cast<std::size_t>(sparsity.rows()));
  for (std::int32_t r = 0; r < sparsity.rows(); ++r) diagonal_.push_back(sparsity.slot(r, r));
}

void BlockMatrix::follow_pattern(std::span<const std::int32_t> rows) {
  values_.resize(static_cast<std::size_t>(9 * sparsity_->blocks() + 1), 0.0);
  for (const std::int32_t row : rows) diagonal_[static_cast<std::size_t>(row)] = sparsity_->slot(row, row);
  renew_id();
}

void BlockMatrix::clear() {
  const auto rows = static_cast<std::int32_t>(values_.size() / 64 + 1);
  threads_.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) {
    const auto size = static_cast<std::int64_t>(values_.size());
    std::fill(values_.begin() + std::min<std::int64_t>(size, std::int64_t{64} * begin),
              values_.begin() + std::min<std::int64_t>(size, std::int64_t{64} * end), 0.0);
  });
  set_couplings(nullptr);
  set_given(nullptr);
  count_change();
}

void BlockMatrix::add(std::int32_t row, std::int32_t column, const Mat3& block) {
  count_change();
  const std::int32_t slot = sparsity_->slot(row, column);
  if (slot < 0) {
    throw Error(
        "the block (" + std::to_string(row) + ", " + std::to_string(column) +
        ") is not in the pattern of the matrix; a model that couples rows at run time adds couplings.");
  }
  double* to = values_.data() + 9 * static_cast<std::ptrdiff_t>(slot);
  for (int i = 0; i < 9; ++i) to[i] += block.data()[i];
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
    multiply_rows_(sparsity_->row_begin.data(), sparsity_->row_end(), sparsity_->column.data(),
                   values_.data(), begin, end, p.data(), out.data());
  });
  if (couplings() != nullptr) couplings()->add_product(threads_, 1.0, p.data(), out.data());
}

void BlockMatrix::diagonal_blocks(Reals blocks) const {
  for (std::int32_t i = 0; i < rows(); ++i) {
    std::copy_n(values_.data() + 9 * diagonal_slot(i), 9, blocks.data() + 9 * static_cast<std::ptrdiff_t>(i));
  }
  if (couplings() != nullptr) couplings()->add_diagonal(blocks);
}

double BlockMatrix::round_off(ConstReals x) const {
  double sum = 0.0;
  for (std::int32_t i = 0; i < rows(); ++i) {
    sum += diagonal_block(i).diagonal().cwiseProduct(block(x, i)).squaredNorm();
  }
  if (couplings() != nullptr) {
    for (std::size_t k = 0; k < couplings()->rows().size(); ++k) {
      const std::int32_t i = couplings()->rows()[k];
      const Vec3 coupled = couplings()->diagonal(static_cast<std::int32_t>(k)).diagonal();
      const Vec3 own = diagonal_block(i).diagonal();
      sum += (own + coupled).cwiseProduct(block(x, i)).squaredNorm() -
             own.cwiseProduct(block(x, i)).squaredNorm();
    }
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
    const std::int64_t end = sparsity_->end_of(r);
    for (auto s = sparsity_->begin_of(r); s < end; ++s) {
      const std::int32_t c = sparsity_->column[static_cast<std::size_t>(s)];
      clear_masked(values_.data() + 9 * s, mask, 0);
      clear_masked(values_.data() + 9 * static_cast<std::int64_t>(sparsity_->slot(c, r)), 0, mask);
    }
    double* diagonal = values_.data() + 9 * diagonal_slot(r);
    for (unsigned i = 0; i < 3; ++i) {
      if (((mask >> i) & 1U) != 0) diagonal[4 * i] = 1.0;
    }
  }
}

/// Room that rows of an open pattern have left, or have left behind, is not read: it depends on the edits
/// before, and work that is counted must not.
std::size_t BlockMatrix::bytes() const {
  auto blocks = static_cast<std::size_t>(sparsity_->blocks());
  if (!sparsity_->open_end.empty()) {
    blocks = 0;
    for (std::int32_t r = 0; r < rows(); ++r)
      blocks += static_cast<std::size_t>(sparsity_->end_of(r) - sparsity_->begin_of(r));
  }
  return (9 * blocks + 1) * sizeof(double) + blocks * sizeof(std::int32_t) +
         (sparsity_->row_begin.size() + sparsity_->open_end.size()) * sizeof(std::int64_t) +
         diagonal_.size() * sizeof(std::int64_t);
}

}  // namespace tissu
