#include "tissu/world/world_edit.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "builder.h"
#include "number_set.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/force/grabs.h"
#include "tissu/force/gravity.h"
#include "tissu/force/instruments.h"
#include "tissu/force/links.h"
#include "tissu/force/load.h"
#include "tissu/viscosity/rayleigh.h"

namespace tissu {
namespace {

/// Of the places of the matrix on the first day: beyond that everything is laid anew.
constexpr std::int64_t kMostBlocks = 2;

/// Of a world that was made for editing.
template <class Held>
auto& editable(Held& held) {
  if (!held)
    throw ParameterError("this world cannot be edited; compile the scene with editing: true to cut.");
  return *held;
}

/// sum w X, in the order in which a world is built.
Vec3 place_of(const FirstDayPoint& point, ConstReals X) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < point.node.size() && point.node[i] >= 0; ++i)
    sum += point.weight[i] * block(X, point.node[i]);
  return sum;
}

/// Forces that know nothing of cells, or follow them here.
bool follows_edits(const ForceModel& force) {
  const auto is = [&]<class... Forces>() {
    return (... || (dynamic_cast<const Forces*>(&force) != nullptr));
  };
  return is
      .operator()<BodyModel, Rayleigh, Gravity, NodalLoad, Pressure, Contact, Links, Grabs, Instruments>();
}

bool follows_edits(const World& world) {
  const auto shares = [](const BodyDescription& body) { return !body.shared.empty(); };
  return std::ranges::none_of(world.description()->bodies, shares) &&
         std::ranges::all_of(world.forces(), [](const auto& force) { return follows_edits(*force); });
}

bool follows_edits(const BodyDescription& described, const Body& body) {
  return !described.frames && !described.viscosity.any() && !body.models.empty() &&
         std::ranges::none_of(body.models,
                              [](const BodyModel* model) { return model->block().plans.empty(); });
}

}  // namespace

bool WorldEdit::serves(const World& world) {
  if (!follows_edits(world)) return false;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    if (follows_edits(world.description()->bodies[i], world.bodies()[i])) return true;
  }
  return false;
}

WorldEdit::WorldEdit(World& world)
    : world_(world),
      bodies_(world.bodies().size()),
      first_blocks_(world.sparsity().blocks()),
      box_(box_of(world.rest_positions(), world.frames())) {
  if (!follows_edits(world)) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) prepare(i);
}

void WorldEdit::prepare(std::size_t number) {
  BodyDescription& body = editable(world_.description_).bodies[number];
  if (!follows_edits(body, world_.bodies_[number])) return;
  EditedBody& edited = bodies_[number];
  for (const BodyModel* model : world_.bodies_[number].models) {
    // The world owns its models, and this its edits.
    std::unique_ptr<CellEditor> editor = const_cast<BodyModel*>(model)->make_editor();
    if (editor == nullptr) {
      edited.editors.clear();
      return;
    }
    edited.editors.push_back(std::move(editor));
  }
  for (ElasticBlock& block : body.elastic) edited.tables.emplace_back(block);
  list_bound(number);
}

std::size_t WorldEdit::number_of(std::string_view body) const {
  return static_cast<std::size_t>(&world_.body(body) - world_.bodies().data());
}

double WorldEdit::volume(std::string_view body, std::span<const std::int32_t> cells) const {
  double sum = 0.0;
  for (const std::int32_t cell : cells) {
    for (const auto& editor : bodies_[number_of(body)].editors) {
      if (editor->has(cell)) sum += editor->volume(cell);
    }
  }
  return sum;
}

double WorldEdit::energy(std::string_view body, std::span<const std::int32_t> cells, ConstReals x) const {
  double sum = 0.0;
  for (const auto& editor : bodies_[number_of(body)].editors) sum += editor->energy(cells, x);
  return sum;
}

WorldDescription& WorldEdit::description() { return editable(world_.description_); }

BodyDescription& WorldEdit::description(std::string_view body) {
  return editable(world_.description_).bodies[number_of(body)];
}

bool WorldEdit::can(std::string_view body, const BodyChange& change) const {
  const std::size_t number = number_of(body);
  const EditedBody& edited = bodies_[number];
  const auto room = at(world_.bodies_[number].room);
  if (edited.editors.empty() || change.copied.size() > room) return false;
  const Sparsity& pattern = world_.sparsity_;
  if (pattern.blocks() > kMostBlocks * first_blocks_ ||
      pattern.blocks() > std::numeric_limits<std::int32_t>::max() / 2)
    return false;
  return std::ranges::all_of(edited.editors, [&](const auto& editor) {
    const auto gone =
        std::ranges::count_if(change.cells.gone, [&](std::int32_t cell) { return editor->has(cell); });
    return static_cast<std::size_t>(gone) < editor->cells();
  });
}

/// The world owns its contact, and this its edits.
void WorldEdit::exchange_surfaces(Contact& other) {
  editable(world_.description_).contact = other.description();
  const_cast<Contact*>(world_.contact_)->exchange_surfaces(other);
}

std::vector<std::int32_t> WorldEdit::apply(std::string_view name, const BodyChange& change,
                                           const CellsAt& cells_at) {
  const std::size_t number = number_of(name);
  add_nodes(number, change);
  const Body& body = world_.bodies_[number];
  for (const auto& editor : bodies_[number].editors)
    editor->edit(change.cells, body.first_node, world_.shape_positions());
  edit_description(number, change);
  std::vector<std::int32_t> rows = change.nodes;
  for (std::int32_t& row : rows) row += body.first_node;
  lay_rows(number, rows, cells_at);
  std::vector<std::int32_t> weighed = rows;
  for (const auto& editor : bodies_[number].editors) {
    const std::vector<std::int32_t> laid = editor->laid_nodes();
    weighed.insert(weighed.end(), laid.begin(), laid.end());
  }
  sort_unique(weighed);
  weigh(number, weighed, cells_at);
  loosen(number, change);
  return rows;
}

/// Room becomes nodes: at rest where those are that they copy, or between nodes of the first day, and free.
void WorldEdit::add_nodes(std::size_t number, const BodyChange& change) {
  Body& body = world_.bodies_[number];
  const auto count = static_cast<std::int32_t>(change.copied.size());
  if (count == 0) return;
  std::vector<FirstDayPoint>& points = editable(world_.description_).bodies[number].points;
  points.insert(points.end(), change.points.begin(), change.points.end());
  for (std::vector<double>* rest : {&world_.rest_.positions, &world_.shape_}) {
    if (rest->empty()) continue;
    const auto own = Reals(*rest).subspan(at(3 * body.first_node));
    for (std::int32_t i = 0; i < count; ++i) {
      const std::int32_t node = change.copied[at(i)];
      const Vec3 place = node >= 0 ? Vec3(block(own, node)) : place_of(points[at(-1 - node)], own);
      block(own, body.node_count + i) = place;
      if (rest == &world_.rest_.positions) box_.extend(place);
    }
  }
  world_.fixed_.free_rows(body.first_node + body.node_count, count);
  body.node_count += count;
  body.room -= count;
  // Room stands where the first node is described: once it is used up, the box may be smaller.
  if (body.room == 0) box_ = box_of(world_.rest_.positions, world_.frames());
  world_.extent_ = diagonal_of(box_);
}

void WorldEdit::edit_description(std::size_t number, const BodyChange& change) {
  BodyDescription& body = editable(world_.description_).bodies[number];
  const auto first_day = static_cast<std::int32_t>(body.positions.size() / 3 - body.copies_of.size());
  for (const std::int32_t node : change.copied) {
    const Vec3 place = node >= 0 ? Vec3(block(ConstReals(body.positions), node))
                                 : place_of(body.points[at(-1 - node)], body.positions);
    body.positions.insert(body.positions.end(), place.data(), place.data() + 3);
    body.copies_of.push_back(node < first_day ? node : body.copies_of[at(node - first_day)]);
  }
  body.room -= static_cast<std::int32_t>(change.copied.size());
  for (std::size_t b = 0; b < body.elastic.size(); ++b)
    bodies_[number].tables[b].apply(change.cells, 0, body.elastic[b]);
  body.bare = change.bare;
  body.next_cell = std::max(body.next_cell, change.next_cell);
}

/// The columns of rows are the nodes of their cells.
void WorldEdit::lay_rows(std::size_t number, std::span<const std::int32_t> rows, const CellsAt& cells_at) {
  const std::int32_t first = world_.bodies_[number].first_node;
  NumberSet columns;
  NumberSet cells;
  for (const std::int32_t row : rows) {
    columns.add(row);
    for (const std::int32_t cell : cells_at(row - first)) {
      cells.add(cell);
      for (const auto& editor : bodies_[number].editors) {
        if (!editor->has(cell)) continue;
        for (const std::int32_t node : editor->nodes(cell)) columns.add(node);
      }
    }
    world_.sparsity_.set_row(row, columns.ascending());
    columns.clear();
  }
  for (const auto& editor : bodies_[number].editors) editor->bind(world_.sparsity_, cells.ascending());
}

void WorldEdit::weigh(std::size_t number, std::span<const std::int32_t> rows, const CellsAt& cells_at) {
  const Body& body = world_.bodies_[number];
  Gravity* gravity = nullptr;
  Rayleigh* damping = nullptr;
  for (const auto& force : world_.forces_) {
    if (auto* found = dynamic_cast<Gravity*>(force.get())) gravity = found;
    auto* found = dynamic_cast<Rayleigh*>(force.get());
    if (found != nullptr && found->damps(body.models.front())) damping = found;
  }
  for (const std::int32_t row : rows) {
    double mass = 0.0;
    double weight = 0.0;
    const auto cells = cells_at(row - body.first_node);
    for (const auto& editor : bodies_[number].editors) editor->add_node(row, cells, mass, weight);
    world_.mass_.set_nodal(row, mass);
    if (gravity != nullptr)
      gravity->set_mass(row, editable(world_.description_).consistent_weight ? weight : mass);
    if (damping != nullptr) damping->set_mass(row, mass);
  }
}

/// Nodes that no cell uses any more are held where they are.
void WorldEdit::loosen(std::size_t number, const BodyChange& change) {
  if (change.loose.empty()) return;
  const Body& body = world_.bodies_[number];
  std::vector<FixedNodes>& all = editable(world_.description_).fixed;
  const auto is_loose = [&](const FixedNodes& fixed) {
    return fixed.body == body.name && !fixed.positions.empty();
  };
  auto held = std::ranges::find_if(all, is_loose);
  if (held == all.end()) {
    all.emplace_back();
    held = all.end() - 1;
    held->body = body.name;
  }
  held->nodes.insert(held->nodes.end(), change.loose.begin(), change.loose.end());
  held->positions.insert(held->positions.end(), change.places.begin(), change.places.end());
  std::vector<std::int32_t> rows = change.loose;
  for (std::int32_t& row : rows) row += body.first_node;
  world_.fixed_.hold_at(rows, change.places);
  std::vector<char>& bound = bodies_[number].bound;
  bound.resize(at(body.node_count), 0);
  for (const std::int32_t node : change.loose) bound[at(node)] = 1;
}

}  // namespace tissu
