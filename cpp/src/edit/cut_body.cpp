#include "tissu/edit/cut_body.h"

#include <algorithm>
#include <utility>

#include "described.h"

namespace tissu {
namespace {

/// Nodes without material: those from before, old ones that lose it, and new ones that never have any.
std::vector<std::int32_t> bare_after(const BodyDescription& body, const CutPlan& plan) {
  std::vector<std::int32_t> bare = body.bare;
  bare.insert(bare.end(), plan.emptied.begin(), plan.emptied.end());
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (!plan.nodes[i].material) bare.push_back(plan.first_node + static_cast<std::int32_t>(i));
  }
  std::ranges::sort(bare);
  bare.erase(std::ranges::unique(bare).begin(), bare.end());
  return bare;
}

BodyEdit edit_of(const BodyDescription& body, const CutState& before, const CutPlan& plan) {
  BodyEdit edit;
  edit.gone = plan.gone;
  for (const BornCell& cell : plan.born)
    edit.born.push_back({cell.number, cell.parent, cell.share, cell.nodes});
  for (const ChangedCell& cell : plan.changed) edit.moved.push_back({cell.number, cell.nodes});
  for (const BornNode& node : plan.nodes) edit.copied.push_back(node.copied);
  edit.bare = bare_after(body, plan);
  CutState after = before;
  after.hosts.apply(plan);
  after.material.apply(plan);
  edit.cut = std::make_shared<const CutState>(std::move(after));
  return edit;
}

void make(const World& world, const State& state, std::string_view name, const CutState& before,
          BodyCut& cut) {
  const CutPlan& plan = cut.plan;
  if (plan.gone.empty() && plan.changed.empty() && plan.material.cells.empty() &&
      plan.material.incisions.empty())
    return;
  const BodyEdit edit = edit_of(described(world, name), before, cut.plan);
  cut.world = edit_body(world, state, name, edit);
  cut.copies = row_copies(world, name, edit);
}

}  // namespace

BodyCut cut_body(const World& world, const State& state, std::string_view name, const Sweep& sweep,
                 const CutOptions& options) {
  const BodyDescription& body = described(world, name);
  refuse_unparted(*world.description(), body);
  const auto first = 3 * static_cast<std::size_t>(world.body(name).first_node);
  const std::shared_ptr<const CutState> before = cut_state(world, name);
  BodyCut result;
  result.plan = plan_cut(before->hosts, before->material,
                         ConstReals(state.positions).subspan(first, body.positions.size()), sweep, options);
  make(world, state, name, *before, result);
  return result;
}

BodyCut ablate_body(const World& world, const State& state, std::string_view name,
                    std::vector<std::int32_t> cells) {
  const BodyDescription& body = described(world, name);
  refuse_unparted(*world.description(), body);
  const std::shared_ptr<const CutState> before = cut_state(world, name);
  BodyCut result;
  result.plan = plan_ablation(before->hosts, before->material, std::move(cells));
  make(world, state, name, *before, result);
  return result;
}

}  // namespace tissu
