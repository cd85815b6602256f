#pragma once

#include <vector>

#include "tissu/assembly/block_matrix.h"

namespace tissu {

/// A block matrix in single precision, scaled so that its largest diagonal number is 1.
class SingleMatrix {
 public:
  /// Finds the scale alone, for a matrix that is not multiplied with in single precision.
  void measure(const BlockMatrix& matrix);
  /// Takes over pattern and values; false where it has them.
  bool update(const BlockMatrix& matrix);
  void multiply(std::span<const float> p, std::span<float> out) const;
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(float); }

 private:
  const BlockMatrix* matrix_ = nullptr;
  std::uint64_t measured_id_ = 0;  ///< of the matrix that has this scale
  std::uint64_t measured_version_ = 0;
  std::uint64_t id_ = 0;
  std::uint64_t version_ = 0;
  double scale_ = 1.0;
  AlignedVector<float> values_;
  void (*multiply_rows_)(const std::int64_t* row_begin, const std::int64_t* row_end,
                         const std::int32_t* column, const float* values, std::int32_t begin,
                         std::int32_t end, const float* p, float* out) = nullptr;
};

}  // namespace tissu
