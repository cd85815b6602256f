#include "tissu/assembly/sparsity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tissu/base/error.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

/// In the room behind a row: above every column, so that a row and its room ascend.
constexpr std::int32_t kNoColumn = std::numeric_limits<std::int32_t>::max();
/// Of a row that moves: a share of its blocks.
constexpr double kMovedRoom = 0.25;

}  // namespace

std::int32_t Sparsity::slot(std::int32_t row, std::int32_t col) const {
  const auto begin = column.begin() + begin_of(row);
  const auto end = column.begin() + end_of(row);
  const auto found = std::lower_bound(begin, end, col);
  return found != end && *found == col ? static_cast<std::int32_t>(found - column.begin()) : -1;
}

void Sparsity::set_row(std::int32_t row, std::span<const std::int32_t> columns) {
  const auto r = static_cast<std::size_t>(row);
  const auto count = static_cast<std::int64_t>(columns.size());
  std::fill(column.begin() + row_begin[r], column.begin() + open_end[r], kNoColumn);
  if (row_begin[r] + count > room_end[r]) {
    const auto room = static_cast<std::size_t>(std::ceil(kMovedRoom * static_cast<double>(count)));
    row_begin[r] = static_cast<std::int64_t>(column.size());
    column.resize(column.size() + columns.size() + room, kNoColumn);
    room_end[r] = row_begin.back() = static_cast<std::int64_t>(column.size());
  }
  std::ranges::copy(columns, column.begin() + row_begin[r]);
  open_end[r] = row_begin[r] + count;
}

void SparsityBuilder::add_cells(std::span<const std::int32_t> nodes, int size) {
  cells_.push_back({{nodes.begin(), nodes.end()}, size});
}

Sparsity SparsityBuilder::build(double room) const {
  // For each row, the cells that touch it, as offsets into one list of nodes.
  std::vector<std::int64_t> first(static_cast<std::size_t>(rows_) + 1, 0);
  for (const Cells& cells : cells_) {
    for (const std::int32_t node : cells.nodes) ++first[static_cast<std::size_t>(node) + 1];
  }
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::span<const std::int32_t>> incident(static_cast<std::size_t>(first.back()));
  std::vector<std::int64_t> next(first.begin(), first.end() - 1);
  for (const Cells& cells : cells_) {
    const auto size = static_cast<std::size_t>(cells.size);
    for (std::size_t c = 0; c < cells.nodes.size(); c += size) {
      const std::span<const std::int32_t> cell(cells.nodes.data() + c, size);
      for (const std::int32_t node : cell) {
        incident[static_cast<std::size_t>(next[static_cast<std::size_t>(node)]++)] = cell;
      }
    }
  }

  Sparsity result;
  result.row_begin.assign(static_cast<std::size_t>(rows_) + 1, 0);
  std::vector<std::int32_t> row;
  for (std::int32_t r = 0; r < rows_; ++r) {
    const auto i = static_cast<std::size_t>(r);
    row.assign(1, r);
    for (auto c = first[i]; c < first[i + 1]; ++c) {
      const auto& cell = incident[static_cast<std::size_t>(c)];
      row.insert(row.end(), cell.begin(), cell.end());
    }
    sort_unique(row);
    result.column.insert(result.column.end(), row.begin(), row.end());
    if (room > 0.0) {
      result.open_end.push_back(static_cast<std::int64_t>(result.column.size()));
      const double spare = std::ceil(room * static_cast<double>(row.size()));
      result.column.insert(result.column.end(), static_cast<std::size_t>(spare), kNoColumn);
      result.room_end.push_back(static_cast<std::int64_t>(result.column.size()));
    }
    result.row_begin[i + 1] = static_cast<std::int64_t>(result.column.size());
  }
  if (result.blocks() > std::numeric_limits<std::int32_t>::max()) {
    throw MeshError("the matrix would have " + std::to_string(result.blocks()) +
                    " blocks and at most 2147483647 can be numbered; use a coarser mesh.");
  }
  return result;
}

}  // namespace tissu
