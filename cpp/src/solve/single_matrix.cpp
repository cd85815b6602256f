#include "single_matrix.h"

#include <algorithm>
#include <cmath>

#include "assembly/kernels/product_list.h"

namespace tissu {

void SingleMatrix::measure(const BlockMatrix& matrix) {
  if (measured_id_ == matrix.id() && measured_version_ == matrix.version()) return;
  measured_id_ = matrix.id();
  measured_version_ = matrix.version();
  double largest = 0.0;
  for (std::int32_t i = 0; i < matrix.rows(); ++i) {
    for (int k = 0; k < 3; ++k) {
      largest = std::max(largest, std::abs(matrix.values()[9 * matrix.diagonal_slot(i) + 4 * k]));
    }
  }
  if (matrix.couplings() != nullptr) {
    for (const std::int32_t i : matrix.couplings()->rows()) {
      const Mat3 D = matrix.diagonal_block(i) + matrix.couplings()->diagonal(matrix.couplings()->place(i));
      largest = std::max(largest, D.diagonal().cwiseAbs().maxCoeff());
    }
  }
  scale_ = largest > 0.0 && std::isfinite(largest) ? 1.0 / largest : 1.0;
}

bool SingleMatrix::update(const BlockMatrix& matrix) {
  matrix_ = &matrix;
  if (id_ == matrix.id() && version_ == matrix.version()) return false;
  measure(matrix);
  id_ = matrix.id();
  version_ = matrix.version();
  multiply_rows_ = multiply_rows_of<float>(matrix.isa());
  const auto blocks = matrix.sparsity().blocks();
  values_.resize(static_cast<std::size_t>(9 * blocks + 1));  // one more can be read
  constexpr std::int64_t kTogether = 8;
  const auto groups = static_cast<std::int32_t>((blocks + kTogether - 1) / kTogether);
  const double* from = matrix.values();
  matrix.threads().for_pieces(groups, [&](std::int32_t begin, std::int32_t end) {
    const std::int64_t last = 9 * std::min(blocks, kTogether * end);
    for (std::int64_t i = 9 * kTogether * begin; i < last; ++i) {
      values_[static_cast<std::size_t>(i)] = static_cast<float>(scale_ * from[i]);
    }
  });
  return true;
}

void SingleMatrix::multiply(std::span<const float> p, std::span<float> out) const {
  const Sparsity& pattern = matrix_->sparsity();
  matrix_->threads().for_pieces(matrix_->rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows_(pattern.row_begin.data(), pattern.row_end(), pattern.column.data(), values_.data(), begin,
                   end, p.data(), out.data());
  });
  const Couplings* couplings = matrix_->couplings();
  if (couplings != nullptr) couplings->add_product(matrix_->threads(), scale_, p.data(), out.data());
}

}  // namespace tissu
