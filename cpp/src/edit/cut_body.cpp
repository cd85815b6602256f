#include "tissu/edit/cut_body.h"

#include <utility>

#include "cut_edit.h"
#include "described.h"
#include "edit/cut/moved_cells.h"
#include "snap_rules.h"
#include "tissu/base/error.h"
#include "tissu/contact/audit.h"
#include "tissu/edit/cut/snap.h"
#include "tissu/edit/repair_body.h"

namespace tissu {
namespace {

BodyEdit edit_of(const BodyDescription& body, const CutState& before, const CutPlan& plan) {
  BodyEdit edit;
  set_cells(plan, edit);
  edit.bare = bare_after(body.bare, plan);
  CutState after = before;
  after.hosts.apply(plan);
  after.material.apply(plan);
  edit.copied = copied_by(after.hosts, plan);
  for (const BornNode& node : plan.nodes) edit.between.push_back(node.between);
  edit.points = first_day_points(after.hosts);
  edit.node_moves = plan.moved;
  if (after.hosts.moved()) edit.rest.assign(after.hosts.rest().begin(), after.hosts.rest().end());
  edit.cut = std::make_shared<const CutState>(std::move(after));
  return edit;
}

/// Number of crossings of bodies in contact after an edit that changed these triangles; 0 if there are no
/// more than before.
std::size_t new_crossings(const Contact& before, const Contact& cut, const State& state, const RowsBorn& born,
                          std::span<const std::uint8_t> changed) {
  State after = state;
  blend_rows(born.blends, after.positions);
  copy_rows(born.copies, after.positions);
  if (!changed.empty() && !any_crosses(cut, after, changed)) return 0;
  const std::size_t many = crossings(cut, after).size();
  return many == 0 || many <= crossings(before, state).size() ? 0 : many;
}

/// The same of all triangles.
std::size_t new_crossings(const World& world, const State& state, const CutWorld& cut) {
  if (world.contact() == nullptr || !world.contact()->description().travel) return 0;
  return new_crossings(*world.contact(), *cut.world->contact(), state, cut.born, {});
}

/// Walls of a cut begin apart in sound material. Where walls of an earlier one are pressed into each other by
/// a share of their gap, thin parts of a new one may not.
[[noreturn]] void refuse(std::string_view name, std::size_t many) {
  throw ParameterError(
      "the cut would leave body \"" + std::string(name) + "\" crossing itself in " + std::to_string(many) +
      (many == 1 ? " place" : " places") +
      ", where walls of an earlier cut press on each other or cells are inside out; let them "
      "part or settle first, and cut then.");
}

CutWorld laid(const World& world, const State& state, std::string_view name, const CutPlan& plan,
              std::vector<std::int32_t> (*nodes_around)(const Hosts&, const CutPlan&)) {
  const BodyEdit edit = edit_of(described(world, name), *cut_state(world, name), plan);
  CutWorld made = {edit_body(world, state, name, edit), rows_born(world, name, edit), {}};
  for (const std::int32_t node : nodes_around(edit.cut->hosts, plan))
    made.around_moves.push_back(made.world->body(name).first_node + node);
  return made;
}

}  // namespace

void refuse_crossings(const Contact& before, const Contact& cut, const State& state, const RowsBorn& born,
                      std::span<const std::uint8_t> changed, std::string_view name) {
  const std::size_t many = new_crossings(before, cut, state, born, changed);
  if (many > 0) refuse(name, many);
}

bool changes(const CutPlan& plan) {
  return !plan.moved.empty() || !plan.gone.empty() || !plan.changed.empty() || !plan.material.cells.empty() ||
         !plan.material.incisions.empty();
}

CutPlan plan_body_cut(const World& world, const State& state, std::string_view name, const Sweep& sweep,
                      const CutOptions& options) {
  const BodyDescription& body = described(world, name);
  refuse_unparted(*world.description(), body);
  const auto first = 3 * static_cast<std::size_t>(world.body(name).first_node);
  const std::shared_ptr<const CutState> before = cut_state(world, name);
  const ConstReals x = ConstReals(state.positions).subspan(first, body.positions.size());
  if (!options.snap) return plan_cut(before->hosts, before->material, x, sweep, options);
  return plan_snapped_cut(before->hosts, before->material, x, sweep, options,
                          snap_rules(world, state, name, before->hosts));
}

CutPlan plan_body_ablation(const World& world, std::string_view name, std::vector<std::int32_t> cells) {
  const BodyDescription& body = described(world, name);
  refuse_unparted(*world.description(), body);
  const std::shared_ptr<const CutState> before = cut_state(world, name);
  return plan_ablation(before->hosts, before->material, std::move(cells));
}

double least_quality(const World& world, std::string_view name, const CutPlan& plan) {
  return least_quality(cut_state(world, name)->hosts, plan);
}

CutWorld cut_world(const World& world, const State& state, std::string_view name, const CutPlan& plan) {
  CutWorld made = laid(world, state, name, plan, nodes_around_moves);
  const std::size_t many = new_crossings(world, state, made);
  if (many > 0) refuse(name, many);
  return made;
}

std::optional<CutWorld> repaired_world(const World& world, const State& state, std::string_view name,
                                       const CutPlan& plan) {
  CutWorld made = laid(world, state, name, plan, nodes_around_changes);
  if (new_crossings(world, state, made) > 0) return std::nullopt;
  return made;
}

}  // namespace tissu
