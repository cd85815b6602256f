#pragma once

/// Blocks of 3x3 in compressed rows, of a matrix that need not be square.

#include <cstdint>
#include <span>
#include <vector>

#include "assembly/kernels/product_list.h"
#include "tissu/base/array.h"
#include "tissu/base/parallel.h"

namespace tissu {

/// Which blocks there are: columns ascend in each row.
struct RowPattern {
  std::vector<std::int64_t> begin;  ///< rows + 1
  std::vector<std::int32_t> column;

  [[nodiscard]] std::int32_t rows() const { return static_cast<std::int32_t>(begin.size()) - 1; }
  [[nodiscard]] std::int64_t blocks() const { return begin.back(); }
  [[nodiscard]] std::int64_t length(std::int32_t i) const {
    return begin[static_cast<std::size_t>(i) + 1] - begin[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::size_t bytes() const {
    return begin.size() * sizeof(std::int64_t) + column.size() * sizeof(std::int32_t);
  }
  [[nodiscard]] std::span<const std::int32_t> row(std::int32_t i) const {
    const auto first = static_cast<std::size_t>(begin[static_cast<std::size_t>(i)]);
    const auto last = static_cast<std::size_t>(begin[static_cast<std::size_t>(i) + 1]);
    return std::span(column).subspan(first, last - first);
  }
};

/// A matrix with a pattern that may belong to someone else.
template <class T>
class BlockRows {
 public:
  /// They outlive this. `end`: of each row; null: where the next one begins.
  void refer(const std::vector<std::int64_t>& begin, const std::vector<std::int32_t>& column, Isa isa,
             const std::int64_t* end = nullptr) {
    begin_ = begin.data();
    end_ = end == nullptr ? begin_ + 1 : end;
    column_ = column.data();
    rows_ = static_cast<std::int32_t>(begin.size()) - 1;
    values_.resize(static_cast<std::size_t>(9 * begin.back() + 1));  // one more can be read
    multiply_ = multiply_rows_of<T>(isa);
  }
  [[nodiscard]] std::int32_t rows() const { return rows_; }
  [[nodiscard]] T* block(std::int64_t b) { return values_.data() + 9 * b; }
  [[nodiscard]] const T* block(std::int64_t b) const { return values_.data() + 9 * b; }
  [[nodiscard]] std::int64_t blocks() const { return begin_[rows_]; }
  /// Rows [begin, end) of out = B p.
  void multiply_rows(std::int32_t begin, std::int32_t end, const T* p, T* out) const {
    multiply_(begin_, end_, column_, values_.data(), begin, end, p, out);
  }
  void multiply(const Threads& threads, const T* p, T* out) const {
    threads.for_pieces(rows_,
                       [&](std::int32_t begin, std::int32_t end) { multiply_rows(begin, end, p, out); });
  }
  [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(T); }
  /// Of the values that a product reads: not the room of an open pattern, which depends on the edits before.
  [[nodiscard]] std::size_t product_bytes() const {
    std::int64_t blocks = 0;
    for (std::int32_t i = 0; i < rows_; ++i) blocks += end_[i] - begin_[i];
    return static_cast<std::size_t>(9 * blocks + 1) * sizeof(T);
  }

 private:
  const std::int64_t* begin_ = nullptr;
  const std::int64_t* end_ = nullptr;
  const std::int32_t* column_ = nullptr;
  std::int32_t rows_ = 0;
  AlignedVector<T> values_;
  MultiplyRows<T> multiply_ = nullptr;
};

}  // namespace tissu
