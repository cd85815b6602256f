#include "block_triangle.h"

#include <algorithm>
#include <numeric>

namespace tissu {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Rows of a group, on average, from which on several threads are faster: fewer are one or two pieces, and
/// leave the order in which memory is read.
constexpr std::int32_t kFewRows = 2 * RowGroups::kPiece;

/// One thread takes the rows as they come, which reads memory in order; several take them group by group, if
/// groups are large enough.
RowGroups grouped(std::int32_t rows, bool reversed, int threads, const std::vector<std::int64_t>& begin,
                  const std::vector<std::int32_t>& column) {
  RowGroups groups;
  groups.rows.resize(at(rows));
  std::iota(groups.rows.begin(), groups.rows.end(), 0);
  if (reversed) std::ranges::reverse(groups.rows);
  groups.begin = {0, rows};
  if (threads == 1) return groups;
  std::vector<std::int32_t> level(at(rows), 0);
  std::int32_t levels = 0;
  for (const std::int32_t r : groups.rows) {
    for (auto s = begin[at(r)]; s < begin[at(r) + 1]; ++s) {
      level[at(r)] = std::max(level[at(r)], level[at(column[at(s)])] + 1);
    }
    levels = std::max(levels, level[at(r)] + 1);
  }
  if (rows < levels * kFewRows) return groups;
  groups.one_by_one = false;
  std::ranges::stable_sort(groups.rows, {}, [&](std::int32_t r) { return level[at(r)]; });
  groups.begin.assign(at(levels) + 1, 0);
  for (const std::int32_t l : level) ++groups.begin[at(l) + 1];
  std::partial_sum(groups.begin.begin(), groups.begin.end(), groups.begin.begin());
  return groups;
}

}  // namespace

void BlockTriangle::update(const BlockMatrix& matrix) {
  if (matrix_ == matrix.id()) return;
  matrix_ = matrix.id();
  gather(matrix);
  transpose();
  count_pairs();
  const int threads = matrix.threads().count();
  forward = grouped(matrix.rows(), false, threads, lower_begin, lower_column);
  backward = grouped(matrix.rows(), true, threads, upper_begin, upper_column);
}

void BlockTriangle::gather(const BlockMatrix& matrix) {
  const Sparsity& pattern = matrix.sparsity();
  lower_begin.assign(1, 0);
  lower_column.clear();
  source_.clear();
  for (std::int32_t r = 0; r < matrix.rows(); ++r) {
    for (auto s = pattern.begin_of(r); pattern.column[at(s)] < r; ++s) {  // the diagonal is always there
      lower_column.push_back(pattern.column[at(s)]);
      source_.push_back(s);
    }
    lower_begin.push_back(static_cast<std::int64_t>(lower_column.size()));
  }
}

void BlockTriangle::transpose() {
  const auto rows = static_cast<std::int32_t>(lower_begin.size()) - 1;
  upper_begin.assign(at(rows) + 1, 0);
  for (const std::int32_t c : lower_column) ++upper_begin[at(c) + 1];
  std::partial_sum(upper_begin.begin(), upper_begin.end(), upper_begin.begin());
  upper_column.resize(lower_column.size());
  upper_place.resize(lower_column.size());
  std::vector<std::int64_t> next(upper_begin.begin(), upper_begin.end() - 1);
  for (std::int32_t r = 0; r < rows; ++r) {
    for (auto b = lower_begin[at(r)]; b < lower_begin[at(r) + 1]; ++b) {
      const std::int64_t to = next[at(lower_column[at(b)])]++;
      upper_column[at(to)] = r;
      upper_place[at(to)] = b;
    }
  }
}

void BlockTriangle::count_pairs() {
  pairs_ = 0;
  std::vector<std::int32_t> mark(lower_begin.size(), -1);
  for (std::int32_t r = 0; r + 1 < static_cast<std::int32_t>(lower_begin.size()); ++r) {
    for (auto b = lower_begin[at(r)]; b < lower_begin[at(r) + 1]; ++b) mark[at(lower_column[at(b)])] = r;
    for (auto b = lower_begin[at(r)]; b < lower_begin[at(r) + 1]; ++b) {
      const std::int32_t j = lower_column[at(b)];
      for (auto c = lower_begin[at(j)]; c < lower_begin[at(j) + 1]; ++c) {
        pairs_ += mark[at(lower_column[at(c)])] == r ? 1 : 0;
      }
    }
  }
}

std::size_t BlockTriangle::bytes() const {
  const auto blocks = lower_column.size();
  return blocks * (2 * sizeof(std::int32_t) + 2 * sizeof(std::int64_t)) +
         lower_begin.size() * (2 * sizeof(std::int64_t) + 2 * sizeof(std::int32_t));
}

}  // namespace tissu
