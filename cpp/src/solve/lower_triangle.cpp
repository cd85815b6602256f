#include "lower_triangle.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/sort_unique.h"

namespace tissu {

bool LowerTriangle::update_pattern(const BlockMatrix& matrix, const Couplings* couplings) {
  std::vector<std::pair<std::int32_t, std::int32_t>> extra;
  if (couplings != nullptr) {
    couplings->for_blocks([&](std::int32_t r, std::int32_t c, const Mat3&) {
      if (c > r && matrix.sparsity().slot(r, c) < 0) extra.emplace_back(r, c);
    });
    sort_unique(extra);
  }
  if (matrix_ == matrix.id() && extra == extra_) return false;
  matrix_ = matrix.id();
  sparsity_ = &matrix.sparsity();
  extra_ = std::move(extra);

  sources_.clear();
  for (std::int32_t r = 0; r < matrix.rows(); ++r) {
    for (auto s = sparsity_->begin_of(r); s < sparsity_->end_of(r); ++s) {
      const std::int32_t c = sparsity_->column[static_cast<std::size_t>(s)];
      if (c >= r) sources_.push_back({r, c, s});
    }
  }
  for (const auto& [r, c] : extra_) sources_.push_back({r, c, -1});
  std::ranges::sort(sources_, {}, [](const Source& s) { return std::pair(s.row, s.column); });

  // Row 3 r + k of the upper triangle is column 3 r + k of the lower one.
  column_begin.assign(1, 0);
  row.clear();
  std::size_t first = 0;
  for (std::int32_t r = 0; r < matrix.rows(); ++r) {
    std::size_t last = first;
    while (last < sources_.size() && sources_[last].row == r) ++last;
    for (int k = 0; k < 3; ++k) {
      for (std::size_t s = first; s < last; ++s) {
        for (int m = sources_[s].column == r ? k : 0; m < 3; ++m) row.push_back(3 * sources_[s].column + m);
      }
      column_begin.push_back(static_cast<int>(row.size()));
    }
    first = last;
  }
  values.resize(row.size());
  return true;
}

void LowerTriangle::update_values(const BlockMatrix& matrix, const Couplings* couplings, double shift) {
  const auto entry = [&](const Source& source, int k, int m) {
    return source.place < 0 ? 0.0 : (matrix.values() + 9 * source.place)[3 * m + k];
  };
  std::size_t to = 0;
  std::size_t first = 0;
  for (std::int32_t r = 0; r < matrix.rows(); ++r) {
    std::size_t last = first;
    while (last < sources_.size() && sources_[last].row == r) ++last;
    for (int k = 0; k < 3; ++k) {
      const std::size_t diagonal = to;
      for (std::size_t s = first; s < last; ++s) {
        for (int m = sources_[s].column == r ? k : 0; m < 3; ++m) values[to++] = entry(sources_[s], k, m);
      }
      if (!matrix.is_given(r, k)) values[diagonal] += shift * std::abs(values[diagonal]);
    }
    first = last;
  }
  if (couplings != nullptr) add(*couplings);
}

void LowerTriangle::add(const Couplings& couplings) {
  couplings.for_blocks([&](std::int32_t r, std::int32_t c, const Mat3& block) {
    if (c < r) return;
    for (int k = 0; k < 3; ++k) {
      const auto column = static_cast<std::size_t>(3 * r + k);
      const auto first = row.begin() + column_begin[column];
      const auto last = row.begin() + column_begin[column + 1];
      for (int m = c == r ? k : 0; m < 3; ++m) {
        const auto found = std::lower_bound(first, last, 3 * c + m);
        values[static_cast<std::size_t>(found - row.begin())] += block(k, m);
      }
    }
  });
}

}  // namespace tissu
