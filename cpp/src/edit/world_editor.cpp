#include "tissu/edit/world_editor.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "cut_edit.h"
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
    bodies_.back().pieces = std::make_unique<PieceTable>(state->hosts, state->material);
  }
}

std::size_t WorldEditor::number_of(std::string_view body) const {
  return static_cast<std::size_t>(&world_->body(body) - world_->bodies().data());
}

BodyChange WorldEditor::change_of(std::size_t body, const CutPlan& plan, const State& state) const {
  const Hosts& hosts = bodies_[body].state->hosts;
  BodyChange change;
  set_cells(plan, change.cells);
  for (const BornNode& node : plan.nodes) change.copied.push_back(node.copied);
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

std::optional<WorldEditor::Made> WorldEditor::make(std::string_view name, const CutPlan& plan,
                                                   const State& state) {
  const std::size_t number = number_of(name);
  CutState* cut = bodies_[number].state.get();
  const auto is_between = [](const BornNode& node) { return node.between.count > 0; };
  if (cut == nullptr || !plan.moved.empty() || std::ranges::any_of(plan.nodes, is_between))
    return std::nullopt;
  const BodyChange change = change_of(number, plan, state);
  if (!edit_.can(name, change)) return std::nullopt;
  const Body& body = world_->bodies()[number];
  Made made;
  for (std::size_t k = 0; k < change.copied.size(); ++k) {
    made.copies.push_back({body.first_node + body.node_count + static_cast<std::int32_t>(k),
                           body.first_node + change.copied[k]});
  }
  std::vector<std::int32_t> rows;
  for (const std::int32_t node : change.nodes) {
    if (node < body.node_count) rows.push_back(body.first_node + node);
  }
  made.before = totals(name, plan.gone, rows, state);
  PieceTable& pieces = *bodies_[number].pieces;
  pieces.begin(cut->hosts, plan);
  cut->hosts.apply(plan);
  cut->material.apply(plan);
  pieces.end(cut->hosts, cut->material, plan);
  made.rows = edit_.apply(name, change, [&](std::int32_t node) { return cut->hosts.cells_at(node); });
  return made;
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
  std::optional<Made> made = make(name, plan, state);
  if (!made) return made;
  BodyDescription& described = edit_.description(name);
  described.cut = bodies_[number_of(name)].state;
  described.uncut = nullptr;
  return made;
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
    throw ParameterError("body \"" + std::string(name) + "\" has no cell " + std::to_string(cell) +
                         " (any more).");
  }
  return make(name, plan, state);
}

}  // namespace tissu
