#include "edit/cut/moved_cells.h"

#include <algorithm>
#include <limits>

#include "edit/cut/remedies.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

std::vector<std::int32_t> cells_at_moves(const Hosts& after, const CutPlan& plan) {
  std::vector<std::int32_t> nodes;
  nodes.reserve(plan.moved.size());
  for (const NodeMove& move : plan.moved) nodes.push_back(move.node);
  sort_unique(nodes);
  std::int32_t number = plan.first_node;
  for (const BornNode& node : plan.nodes) {
    if (node.between.count == 0 && std::ranges::binary_search(nodes, node.copied)) nodes.push_back(number);
    ++number;  // it is greater than all before, so that the list ascends
  }
  std::vector<std::int32_t> cells;
  for (const std::int32_t node : nodes) {
    const auto around = after.cells_at(node);
    cells.insert(cells.end(), around.begin(), around.end());
  }
  sort_unique(cells);
  return cells;
}

std::vector<std::int32_t> nodes_of(const Hosts& hosts, const std::vector<std::int32_t>& cells) {
  std::vector<std::int32_t> nodes;
  for (const std::int32_t cell : cells) {
    const auto own = hosts.nodes(cell);
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  sort_unique(nodes);
  return nodes;
}

}  // namespace

std::vector<std::int32_t> nodes_around_moves(const Hosts& after, const CutPlan& plan) {
  return nodes_of(after, cells_at_moves(after, plan));
}

std::vector<std::int32_t> nodes_around_changes(const Hosts& after, const CutPlan& plan) {
  std::vector<std::int32_t> cells = cells_at_moves(after, plan);
  for (const BornCell& cell : plan.born) cells.push_back(cell.number);
  for (const ChangedCell& cell : plan.changed) cells.push_back(cell.number);
  return nodes_of(after, cells);
}

double least_quality(const Hosts& after, const CutPlan& plan) {
  std::vector<std::int32_t> cells = cells_at_moves(after, plan);
  for (const BornCell& born : plan.born) cells.push_back(born.number);
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t cell : cells) {
    if (after.type(cell) != CellType::tetra) continue;
    const auto nodes = after.nodes(cell);
    const auto place = [&](std::size_t i) -> Vec3 { return block(after.rest(), nodes[i]); };
    least = std::min(least, tetra_quality(place(0), place(1), place(2), place(3)));
  }
  return least;
}

}  // namespace tissu
