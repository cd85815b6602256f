#include "tissu/edit/world_editor.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "contact_edit.h"
#include "cut_edit.h"
#include "edit/cut/material_before.h"
#include "edit/cut/missing_cell.h"
#include "parted_loads.h"
#include "parted_pressures.h"
#include "parted_supports.h"
#include "tissu/base/error.h"
#include "tissu/base/sort_unique.h"
#include "tissu/edit/cut_body.h"
#include "tissu/element/reference_cell.h"

namespace tissu {

WorldDescription described_apart(const World& world) {
  WorldDescription description = *world.description();
  for (BodyDescription& body : description.bodies) {
    body.uncut = nullptr;
    if (body.cut != nullptr) body.cut = std::make_shared<const CutState>(*body.cut);
  }
  if (world.contact() != nullptr) description.separated = world.rest_positions();
  return description;
}

std::shared_ptr<World> laid_anew(const World& world) {
  return std::make_shared<World>(described_apart(world));
}

namespace {

std::shared_ptr<World> own(std::shared_ptr<const World> world) {
  if (world.use_count() == 1) return std::const_pointer_cast<World>(std::move(world));
  return laid_anew(*world);
}

}  // namespace

bool WorldEditor::serves(const World& world) {
  return world.description() != nullptr && WorldEdit::serves(world);
}

WorldEditor::WorldEditor(std::shared_ptr<const World> world)
    : world_(own(std::move(world))), shown_(world_), edit_(*world_) {
  for (const Body& body : world_->bodies()) {
    BodyDescription& described = edit_.description(body.name);
    bodies_.emplace_back();
    if (!has_material(described)) continue;
    std::shared_ptr<CutState>& state = bodies_.back().state;
    const bool was_cut = described.cut != nullptr;  // which other worlds may share
    state = std::make_shared<CutState>(was_cut ? *described.cut : cut_state_of(described));
    (was_cut ? described.cut : described.uncut) = state;
    track(bodies_.size() - 1);
  }
}

WorldEditor::~WorldEditor() = default;

/// What is kept beside the state of a body follows from it.
void WorldEditor::track(std::size_t body) {
  EditedBody& edited = bodies_[body];
  const std::string& name = world_->bodies()[body].name;
  edited.pieces = std::make_unique<PieceTable>(edited.state->hosts, edited.state->material);
  if (edit_.follows(name)) edited.touching = ContactEdit::make(*world_, name, *edited.state);
}

std::size_t WorldEditor::number_of(std::string_view body) const {
  return static_cast<std::size_t>(&world_->body(body) - world_->bodies().data());
}

BodyChange WorldEditor::change_of(std::size_t body, const CutPlan& plan, const State& state) const {
  const Hosts& hosts = bodies_[body].state->hosts;
  BodyChange change;
  set_cells(plan, change.cells);
  auto points = static_cast<std::int32_t>(hosts.points().size());
  for (const BornNode& node : plan.nodes) {
    const bool is_copy = node.between.count == 0;
    change.copied.push_back(is_copy ? node.copied : -1 - points++);
    if (!is_copy) change.points.push_back(first_day_point(hosts.on_first_day(node.between)));
  }
  change.bare = bare_after(world_->description()->bodies[body].bare, plan);
  change.next_cell = plan.born.empty() ? 0 : plan.born.back().number + 1;
  std::vector<std::int32_t> left;  // that cells leave
  std::vector<std::int32_t> used;  // that these cells, or cells in their places, have afterwards
  std::vector<std::int32_t> cells = plan.gone;
  const auto add = [](auto nodes, std::vector<std::int32_t>& to) {
    to.insert(to.end(), nodes.begin(), nodes.end());
  };
  for (const CellEdit::Cell& cell : change.cells.born) add(std::span(cell.nodes), used);
  for (const CellEdit::Moved& cell : change.cells.moved) {
    add(std::span(cell.nodes), used);
    cells.push_back(cell.number);
  }
  for (const std::int32_t cell : cells) add(hosts.nodes(cell), left);
  for (auto* list : {&cells, &left, &used}) sort_unique(*list);
  std::ranges::set_union(left, used, std::back_inserter(change.nodes));
  const std::int32_t first = world_->bodies()[body].first_node;
  for (const std::int32_t node : left) {
    const auto at_node = hosts.cells_at(node);
    if (std::ranges::binary_search(used, node) || !std::ranges::includes(cells, at_node)) continue;
    change.loose.push_back(node);
    const Vec3 x = block(ConstReals(state.positions), first + node);
    change.places.insert(change.places.end(), x.data(), x.data() + 3);
  }
  return change;
}

void WorldEditor::apply(std::size_t body, const CutPlan& plan) {
  auto& [cut, pieces, touching] = bodies_[body];
  pieces->begin(cut->hosts, plan);
  if (touching != nullptr) touching->begin(*cut, plan);
  cut->hosts.apply(plan);
  cut->material.apply(plan);
  pieces->end(cut->hosts, cut->material, plan);
  if (touching != nullptr) touching->end(*cut, plan);
}

/// The contact after a plan that was applied.
std::unique_ptr<Contact> WorldEditor::parted_contact(std::size_t number, const CutPlan& plan) const {
  const EditedBody& edited = bodies_[number];
  const ConstReals before = world_->shape_positions();
  std::vector<double> rest(before.begin(), before.end());
  const ConstReals own = edited.state->hosts.rest();
  std::ranges::copy(own, rest.begin() + std::ptrdiff_t{3} * world_->bodies()[number].first_node);
  return edited.touching->of_material(*edited.state, plan, rest);
}

std::optional<WorldEditor::Made> WorldEditor::make(std::string_view name, const CutPlan& plan,
                                                   const State& state, Verb verb) {
  const std::size_t number = number_of(name);
  CutState* cut = bodies_[number].state.get();
  if (cut == nullptr || !plan.moved.empty()) return std::nullopt;
  const BodyChange change = change_of(number, plan, state);
  if (cut->hosts.moved() && !change.points.empty()) return std::nullopt;
  const ContactEdit* touching = bodies_[number].touching.get();
  if (!edit_.can(name, change) || (touching != nullptr && !touching->follows_cells())) return std::nullopt;
  const bool bound = edit_.parts_bound(name, change);
  if (bound && !edit_.may_part_bound(name, change, state)) return std::nullopt;
  const Body& body = world_->bodies()[number];
  Made made;
  BodyEdit nodes;
  nodes.copied = change.copied;
  for (const BornNode& node : plan.nodes) nodes.between.push_back(node.between);
  made.born = rows_born(*world_, name, nodes);
  std::vector<std::int32_t> rows;
  for (const std::int32_t node : change.nodes) {
    if (node < body.node_count) rows.push_back(body.first_node + node);
  }
  made.before = totals(name, plan.gone, rows, state);
  std::optional<MaterialBefore> before;
  if (touching != nullptr && verb == Verb::cut && touching->refuses()) before.emplace(cut->material, plan);
  apply(number, plan);
  BodyDescription& described = edit_.description(name);
  const bool has_cuts = verb == Verb::cut || described.cut != nullptr;
  if (touching != nullptr && has_cuts) made.contact = parted_contact(number, plan);
  if (before) {
    try {
      refuse_crossings(*world_->contact(), *made.contact, state, made.born, touching->changed(*made.contact),
                       name);
    } catch (const ParameterError&) {
      before->restore(cut->material);
      *cut = cut_state_of(described, std::move(cut->material));
      track(number);
      throw;
    }
  }
  made.rows = edit_.apply(name, change, [&](std::int32_t node) { return cut->hosts.cells_at(node); });
  if (has_cuts) {
    described.cut = bodies_[number].state;
    described.uncut = nullptr;
  } else if (touching != nullptr) {
    made.contact = touching->of_cells(described, world_->shape_positions());
  }
  part_pressures(edit_.description().pressures, described);
  edit_.renew_pressures(name);
  if (bound) part_bound(name, change, verb);
  if (made.contact != nullptr) edit_.exchange_surfaces(*made.contact);
  return made;
}

/// Supports and loads go to copies with material, as in edit_body and remove_cells.
void WorldEditor::part_bound(std::string_view name, const BodyChange& change, Verb verb) {
  WorldDescription& description = edit_.description();
  const BodyDescription& described = edit_.description(name);
  if (verb == Verb::cut) {
    part_supports(description, described, change.copied);
  } else {
    free_unneeded(description, described);
  }
  part_loads(description.loads, described);
  for (FixedNodes& fixed : description.fixed) {
    if (fixed.body != name || !fixed.positions.empty()) continue;
    std::erase_if(fixed.nodes,
                  [&](std::int32_t node) { return std::ranges::binary_search(change.loose, node); });
  }
  std::erase_if(description.fixed, [](const FixedNodes& fixed) { return fixed.nodes.empty(); });
  edit_.renew_loads(name);
  edit_.renew_supports();
}

BodyTotals WorldEditor::totals(std::string_view name, std::span<const std::int32_t> cells,
                               std::span<const std::int32_t> rows, const State& state) const {
  BodyTotals result = tissu::totals(*world_, state, rows);
  result.volume = edit_.volume(name, cells);
  result.elastic = edit_.energy(name, cells, state.positions);
  return result;
}

std::vector<Piece> WorldEditor::pieces(std::string_view name) const {
  const EditedBody& body = bodies_[number_of(name)];
  if (body.state == nullptr) return {};
  return body.pieces->list(body.state->hosts, body.state->material);
}

std::optional<WorldEditor::Made> WorldEditor::cut(std::string_view name, const CutPlan& plan,
                                                  const State& state) {
  return make(name, plan, state, Verb::cut);
}

std::optional<WorldEditor::Made> WorldEditor::remove(std::string_view name,
                                                     std::span<const std::int32_t> cells,
                                                     const State& state) {
  const std::shared_ptr<CutState>& cut = bodies_[number_of(name)].state;
  if (cut == nullptr) return std::nullopt;
  CutPlan plan;
  plan.gone.assign(cells.begin(), cells.end());
  sort_unique(plan.gone);
  for (const std::int32_t cell : plan.gone) {
    if (cut->hosts.has(cell)) continue;
    throw missing_cell(cell, name);
  }
  return make(name, plan, state, Verb::remove);
}

}  // namespace tissu
