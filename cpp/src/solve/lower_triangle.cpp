#include "lower_triangle.h"

#include <algorithm>
#include <cmath>

namespace tissu {

bool LowerTriangle::update_pattern(const BlockMatrix& matrix) {
  std::vector<std::pair<std::int32_t, std::int32_t>> extra;
  for (const ExtraBlock& e : matrix.extra()) extra.emplace_back(e.row, e.column);
  if (matrix_ == matrix.id() && extra == extra_) return false;
  matrix_ = matrix.id();
  sparsity_ = &matrix.sparsity();
  extra_ = std::move(extra);

  sources_.clear();
  for (std::int32_t r = 0; r < matrix.rows(); ++r) {
    for (auto s = sparsity_->row_begin[static_cast<std::size_t>(r)];
         s < sparsity_->row_begin[static_cast<std::size_t>(r) + 1]; ++s) {
      const std::int32_t c = sparsity_->column[static_cast<std::size_t>(s)];
      if (c >= r) sources_.push_back({r, c, s});
    }
  }
  for (std::size_t e = 0; e < extra_.size(); ++e) {
    const auto [r, c] = extra_[e];
    if (c > r) sources_.push_back({r, c, -1 - static_cast<std::int64_t>(e)});
  }
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

void LowerTriangle::update_values(const BlockMatrix& matrix, double shift) {
  const auto entry = [&](const Source& source, int k, int m) {
    const double* block = source.place >= 0
                              ? matrix.values() + 9 * source.place
                              : matrix.extra()[static_cast<std::size_t>(-1 - source.place)].values.data();
    return block[3 * m + k];
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
}

}  // namespace tissu
