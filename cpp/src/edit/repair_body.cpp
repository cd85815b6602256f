#include "tissu/edit/repair_body.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "acted_on.h"
#include "cell_kinds.h"
#include "debris.h"
#include "described.h"
#include "repair_energy.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

bool is_in_contact(const WorldDescription& description, std::string_view body) {
  if (!description.contact) return false;
  return std::ranges::any_of(description.contact->bodies, [&](const auto& one) { return one.name == body; });
}

RepairRules rules_of(const World& world, std::string_view name, const Hosts& hosts,
                     const RepairOptions& options) {
  const WorldDescription& description = *world.description();
  const auto body = [&] {
    BodyDescription own = described(world, name);
    number_cells(own);
    return std::make_shared<const BodyDescription>(std::move(own));
  }();
  RepairRules rules;
  rules.may_move.assign(at(hosts.node_count()), 1);
  rules.is_held.assign(at(hosts.node_count()), 0);
  keep_acted_on(description, name, rules.may_move);
  mark_held(description, name, rules.is_held);
  const auto is_of_body = [&](const auto& one) { return one.body == name; };
  rules.surface_stays =
      is_in_contact(description, name) || std::ranges::any_of(description.pressures, is_of_body);
  const auto kinds = std::make_shared<const CellKinds>(*body);
  rules.are_alike = [body, kinds, &hosts, &options](const std::vector<std::int32_t>& cells) {
    const auto region = [&](std::int32_t cell) {
      return options.regions.empty() ? 0 : options.regions[at(hosts.origin(cell))];
    };
    return kinds->are_alike(cells) && std::ranges::all_of(cells, [&](std::int32_t cell) {
             return region(cell) == region(cells.front());
           });
  };
  rules.allows_jump = [body, kinds, &options, isa = description.isa](
                          std::int32_t cell, const PatchCells& before, const PatchCells& after) {
    const CellKinds::Place& place = kinds->place(cell);
    return is_small_jump(body->elastic[place.block], place.cell, isa, before, after, options.jump);
  };
  return rules;
}

}  // namespace

void refuse_unrepaired(const World& world, std::string_view name) {
  const BodyDescription& body = described(world, name);
  const auto refuse = [&](const std::string& why) {
    throw ParameterError("the cells of body \"" + body.name + "\" cannot be repaired: " + why + ".");
  };
  if (!body.viscosity.prony.empty()) {
    refuse(
        "it has a viscosity with a memory, which other cells do not take over; take one without, or leave "
        "repair out");
  }
  const auto cut = cut_state(world, name);
  const std::vector<std::int32_t> cells = cut->hosts.numbers();
  if (!cut->material.riders.empty() ||
      std::ranges::any_of(cells, [&](std::int32_t cell) { return cut->hosts.share(cell) < 1.0; })) {
    refuse("it was cut by virtual copies, which are not repaired; take method: subdivide or snap");
  }
  if (std::ranges::none_of(cells,
                           [&](std::int32_t cell) { return cut->hosts.type(cell) == CellType::tetra; })) {
    refuse("it has no tetrahedra of first order, which alone are repaired; leave repair out");
  }
}

RepairPlan plan_body_repair(const World& world, const State& state, std::string_view name,
                            const RepairOptions& options) {
  refuse_unrepaired(world, name);
  const BodyDescription& body = described(world, name);
  const std::shared_ptr<const CutState> before = cut_state(world, name);
  const auto first = 3 * at(world.body(name).first_node);
  const ConstReals x = ConstReals(state.positions).subspan(first, body.positions.size());
  return plan_repair(before->hosts, before->material, x, rules_of(world, name, before->hosts, options),
                     options);
}

}  // namespace tissu
