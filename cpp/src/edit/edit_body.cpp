#include "tissu/edit/edit_body.h"

#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "body_surface.h"
#include "cut_surface.h"
#include "debris.h"
#include "edit/cut/missing_cell.h"
#include "parted_loads.h"
#include "parted_pressures.h"
#include "parted_supports.h"
#include "tissu/base/error.h"
#include "tissu/edit/cut_state.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

/// Where the cells of a body stand, by their numbers.
struct CellPlace {
  std::size_t block = 0;
  std::size_t place = 0;
};
using CellPlaces = std::unordered_map<std::int32_t, CellPlace>;

CellPlaces cell_places(const BodyDescription& body) {
  CellPlaces places;
  for (std::size_t b = 0; b < body.elastic.size(); ++b) {
    const std::vector<std::int32_t>& numbers = body.elastic[b].cell_numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) places[numbers[i]] = {b, i};
  }
  return places;
}

CellPlace place_of(const CellPlaces& places, std::int32_t number, const BodyDescription& body) {
  const auto found = places.find(number);
  if (found != places.end()) return found->second;
  throw missing_cell(number, body.name);
}

/// sum w X, in the order of `Rider::at`.
Vec3 place_of(const BodyDescription& body, const FirstDayPoint& point) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < point.node.size() && point.node[i] >= 0; ++i)
    sum += point.weight[i] * block(ConstReals(body.positions), point.node[i]);
  return sum;
}

void add_nodes(BodyDescription& body, const std::vector<std::int32_t>& copied) {
  const auto wanted = static_cast<std::int32_t>(copied.size());
  if (wanted > body.room) {
    throw ParameterError(
        "the cut makes " + std::to_string(wanted) + " nodes of body \"" + body.name +
        "\" where there is room for " + std::to_string(body.room) +
        "; compile the scene with a larger room of editing, a share of the nodes of the body.");
  }
  const auto first_day =
      static_cast<std::int32_t>(body.positions.size() / 3) - static_cast<std::int32_t>(body.copies_of.size());
  for (const std::int32_t node : copied) {
    if (node < 0) {
      const Vec3 place = place_of(body, body.points[static_cast<std::size_t>(-1 - node)]);
      body.positions.insert(body.positions.end(), place.data(), place.data() + 3);
      body.copies_of.push_back(node);
      continue;
    }
    const auto at = 3 * static_cast<std::size_t>(node);
    for (std::size_t k = 0; k < 3; ++k) body.positions.push_back(body.positions[at + k]);
    body.copies_of.push_back(node < first_day ? node
                                              : body.copies_of[static_cast<std::size_t>(node - first_day)]);
  }
  body.room -= wanted;
}

std::span<std::int32_t> nodes_of(ElasticBlock& block, std::size_t place) {
  const auto nodes = static_cast<std::size_t>(find_element(block.element)->nodes);
  return std::span(block.cells).subspan(place * nodes, nodes);
}

/// Values that were one for all become one for each cell.
void spread(std::vector<double>& values, std::size_t cells) {
  if (values.size() == 1) values.assign(cells, values.front());
}

/// The block without the cells that go and with those that are born of them, in ascending number.
ElasticBlock edited_block(const ElasticBlock& block, const BodyEdit& edit,
                          const std::vector<const BodyEdit::Cell*>& born, const CellPlaces& places) {
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < block.cell_numbers.size(); ++i) {
    if (!std::ranges::binary_search(edit.gone, block.cell_numbers[i])) which.push_back(i);
  }
  const std::size_t kept = which.size();
  for (const BodyEdit::Cell* cell : born) which.push_back(places.at(cell->parent).place);
  ElasticBlock edited = part_of(block, which);
  if (edited.origins.empty()) edited.origins = edited.cell_numbers;
  if (edit.inherits) edited.heirs_of = edited.cell_numbers;
  if (!born.empty()) spread(edited.share, which.size());
  for (std::size_t i = 0; i < born.size(); ++i) {
    edited.cell_numbers[kept + i] = born[i]->number;
    edited.share[kept + i] = born[i]->share;
    const std::span<std::int32_t> nodes = nodes_of(edited, kept + i);
    if (nodes.size() != born[i]->nodes.size()) {
      throw ParameterError("the edit gives cell " + std::to_string(born[i]->number) + " " +
                           std::to_string(born[i]->nodes.size()) + " nodes where its parent has " +
                           std::to_string(nodes.size()) + ".");
    }
    std::ranges::copy(born[i]->nodes, nodes.begin());
  }
  return edited;
}

void edit_cells(BodyDescription& body, const BodyEdit& edit) {
  const CellPlaces places = cell_places(body);
  for (const std::int32_t number : edit.gone) (void)place_of(places, number, body);
  std::vector<std::vector<const BodyEdit::Cell*>> born(body.elastic.size());
  for (const BodyEdit::Cell& cell : edit.born)
    born[place_of(places, cell.parent, body).block].push_back(&cell);
  for (const BodyEdit::Moved& moved : edit.moved) {
    const CellPlace at = place_of(places, moved.number, body);
    std::ranges::copy(moved.nodes, nodes_of(body.elastic[at.block], at.place).begin());
  }
  for (std::size_t b = 0; b < body.elastic.size(); ++b) {
    body.elastic[b] = edited_block(body.elastic[b], edit, born[b], places);
  }
  std::erase_if(body.elastic, [](const ElasticBlock& block) { return block.cells.empty(); });
}

/// Live numbers of a support or load are one for each of its nodes, so that it keeps its nodes meanwhile.
void refuse_live_changes(const World& world, const State& state, const WorldDescription& before,
                         const WorldDescription& after) {
  for (std::size_t i = 0; i < before.fixed.size(); ++i) {
    const FixedNodes& support = before.fixed[i];
    if (support.name.empty() || !world.fixed().is_led_live(support.name, state)) continue;
    if (support.nodes == after.fixed[i].nodes) continue;
    throw ParameterError("the cut parts nodes of the support \"" + support.name +
                         "\", which is led live; release it first, or lead it after the cut.");
  }
  for (std::size_t i = 0; i < before.loads.size(); ++i) {
    const LoadDescription& load = before.loads[i];
    if (load.nodes == after.loads[i].nodes || state.memory[world.memory().find(load.name)].empty()) continue;
    throw ParameterError("the cut parts nodes of the " + load.name +
                         ", which was changed while it runs; reset it first.");
  }
}

}  // namespace

void refuse_unparted(const WorldDescription& description, const BodyDescription& body) {
  const auto refuse = [&](const std::string& why) {
    throw ParameterError("body \"" + body.name + "\" cannot be cut: " + why + ".");
  };
  if (!has_material(body)) {
    refuse("its points listen to frames, and bodies whose cells have nodes of their own are accepted");
  }
  for (const ElasticBlock& block : body.elastic) {
    if (std::holds_alternative<CondensedOptions>(block.model)) {
      refuse("its cells are condensed, and a model that keeps each cell is accepted, such as fem");
    }
    if (const auto* springs = std::get_if<MassSpringOptions>(&block.model);
        springs && springs->equal_masses) {
      refuse(
          "its nodes have equal masses, which copies of nodes would change; take masses: volume, the "
          "default");
    }
  }
  refuse_pressed(description, body);
  if (!description.contact) return;
  for (const SurfaceDescription& surface : description.contact->bodies) {
    if (surface.name != body.name) continue;
    if (has_own_mesh(surface)) {
      refuse(
          "its surface in contact is a mesh of its own, which a cut does not part; leave it out of "
          "surface_of");
    }
    refuse_curved(body);
  }
}

BodyDescription edited(BodyDescription body, const BodyEdit& edit) {
  number_cells(body);
  if (!edit.points.empty()) body.points = edit.points;
  add_nodes(body, edit.copied);
  if (!edit.rest.empty()) {
    body.positions = edit.rest;
    body.moved = true;
  }
  edit_cells(body, edit);
  body.bare = edit.bare;
  body.cut = edit.cut;
  body.uncut = nullptr;
  body.next_cell = std::max(body.next_cell, edit.next_cell);
  return body;
}

std::shared_ptr<const World> edit_body(const World& world, const State& state, std::string_view name,
                                       const BodyEdit& edit) {
  if (world.description() == nullptr) {
    throw ParameterError("this world cannot be edited; compile the scene with editing: true to cut.");
  }
  WorldDescription description = *world.description();
  BodyDescription& body = description.body(name);
  refuse_unparted(description, body);
  refuse_tied(description, name, edit.copied);
  body = edited(std::move(body), edit);
  part_supports(description, body, edit.copied);
  part_loads(description.loads, body);
  part_pressures(description.pressures, body);
  refuse_live_changes(world, state, *world.description(), description);
  std::erase_if(description.fixed, [](const FixedNodes& fixed) { return fixed.nodes.empty(); });
  hold_debris(description, body, state, world.body(name).first_node);
  if (description.contact) {
    part_pairs(*description.contact, body.name, world.body(name).node_count, edit.copied, body.points);
  }
  renew_surface(description, body);
  return std::make_shared<World>(std::move(description), &world, true);
}

RowsBorn rows_born(const World& world, std::string_view name, const BodyEdit& edit) {
  const Body& body = world.body(name);
  RowsBorn born;
  const auto add = [&](std::int32_t to, const Rider& between) {
    RowBlend& blend = born.blends.emplace_back();
    blend.to = body.first_node + to;
    for (std::size_t i = 0; i < static_cast<std::size_t>(between.count); ++i) {
      blend.from[i] = body.first_node + between.node[i];
      blend.weight[i] = between.weight[i];
    }
  };
  for (const NodeMove& move : edit.node_moves) add(move.node, move.to);
  for (std::size_t k = 0; k < edit.copied.size(); ++k) {
    const std::int32_t to = body.node_count + static_cast<std::int32_t>(k);
    const std::int32_t from = edit.copied[k];
    if (from >= 0) {
      born.copies.push_back({body.first_node + to, body.first_node + from});
      if (body.first_frame < 0) continue;
      const auto rotation = [&](std::int32_t node) {
        return world.frames()[static_cast<std::size_t>(body.first_frame + node)].rotation;
      };
      born.copies.push_back({rotation(to), rotation(from), body.first_frame + to, body.first_frame + from});
      continue;
    }
    add(to, edit.between[k]);
  }
  return born;
}

}  // namespace tissu
