#include "cut_edit.h"

#include <algorithm>

#include "tissu/base/sort_unique.h"

namespace tissu {

std::vector<std::int32_t> bare_after(const std::vector<std::int32_t>& before, const CutPlan& plan) {
  std::vector<std::int32_t> bare = before;
  bare.insert(bare.end(), plan.emptied.begin(), plan.emptied.end());
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (!plan.nodes[i].material) bare.push_back(plan.first_node + static_cast<std::int32_t>(i));
  }
  sort_unique(bare);
  return bare;
}

FirstDayPoint first_day_point(const Rider& rider) {
  FirstDayPoint point;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rider.count); ++i) {
    point.node[i] = rider.node[i];
    point.weight[i] = rider.weight[i];
  }
  return point;
}

std::vector<FirstDayPoint> first_day_points(const Hosts& hosts) {
  std::vector<FirstDayPoint> points;
  points.reserve(hosts.points().size());
  for (const Rider& rider : hosts.points()) points.push_back(first_day_point(rider));
  return points;
}

std::vector<std::int32_t> copied_by(const Hosts& after, const CutPlan& plan) {
  std::vector<std::int32_t> copied;
  std::int32_t number = plan.first_node;
  for (const BornNode& node : plan.nodes) {
    const bool is_copy = node.between.count == 0;
    copied.push_back(is_copy ? node.copied : after.root(number));
    ++number;
  }
  return copied;
}

void set_cells(const CutPlan& plan, CellEdit& edit) {
  edit.gone = plan.gone;
  for (const BornCell& cell : plan.born)
    edit.born.push_back({cell.number, cell.parent, cell.share, cell.nodes});
  for (const ChangedCell& cell : plan.changed) edit.moved.push_back({cell.number, cell.nodes});
}

}  // namespace tissu
