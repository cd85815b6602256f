#include "snap_rules.h"

#include <algorithm>
#include <memory>
#include <unordered_map>
#include <utility>

#include "debris.h"
#include "described.h"
#include "patch_energies.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Which block of a body a cell is in, and where.
struct Place {
  std::size_t block;
  std::size_t cell;
};
using Places = std::unordered_map<std::int32_t, Place>;

bool alike(const std::vector<double>& values, std::size_t a, std::size_t b) {
  return values.size() == 1 || values[a] == values[b];
}

bool alike(const LawParameters& parameters, std::size_t a, std::size_t b) {
  return std::ranges::all_of(parameters, [&](const auto& one) { return alike(one.second, a, b); });
}

/// Whether two cells of a block have one law and density.
bool alike(const ElasticBlock& block, std::size_t a, std::size_t b) {
  return alike(block.density, a, b) && alike(block.share, a, b) && alike(block.parameters, a, b) &&
         std::ranges::all_of(block.reinforcements,
                             [&](const LawUse& use) { return alike(use.parameters, a, b); });
}

bool is_of_one_kind(const BodyDescription& body, const Places& places, std::span<const std::int32_t> cells) {
  return std::ranges::all_of(cells, [&](std::int32_t cell) {
    const Place& first = places.at(cells.front());
    const Place& own = places.at(cell);
    return own.block == first.block && alike(body.elastic[own.block], first.cell, own.cell);
  });
}

/// Nodes on which something acts.
void keep_acted_on(const WorldDescription& description, const BodyDescription& body,
                   std::vector<char>& may_move) {
  const auto keep = [&](std::int32_t node) { may_move[at(node)] = 0; };
  for (const FixedNodes& fixed : description.fixed) {
    if (fixed.body == body.name) std::ranges::for_each(fixed.nodes, keep);
  }
  for (const LoadDescription& load : description.loads) {
    if (load.body == body.name) std::ranges::for_each(load.nodes, keep);
  }
  for (const BodyDescription& tissue : description.bodies) {
    for (const SharedNode& tie : tissue.shared) {
      if (tie.body == body.name) keep(tie.node);
    }
  }
}

bool is_on_surface(const Hosts& hosts, std::int32_t node) {
  std::unordered_map<std::uint64_t, int> faces;
  for (const std::int32_t cell : hosts.cells_at(node)) {
    const auto nodes = hosts.corners(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (nodes[i] == node || nodes[k] == node) continue;
        const auto [low, high] = std::minmax(nodes[i], nodes[k]);
        ++faces[static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(high)];
      }
    }
  }
  return std::ranges::any_of(faces, [](const auto& face) { return face.second == 1; });
}

}  // namespace

SnapRules snap_rules(const World& world, const State& state, std::string_view name, const Hosts& hosts) {
  const WorldDescription& description = *world.description();
  BodyDescription body = described(world, name);
  number_cells(body);
  SnapRules rules;
  rules.may_move.assign(at(hosts.node_count()), body.viscosity.prony.empty() ? 1 : 0);
  Places places;
  for (std::size_t b = 0; b < body.elastic.size(); ++b) {
    const std::vector<std::int32_t>& numbers = body.elastic[b].cell_numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) places[numbers[i]] = {b, i};
  }
  const bool is_pressed =
      std::ranges::any_of(description.pressures, [&](const auto& one) { return one.body == name; });
  for (std::int32_t node = 0; node < hosts.node_count(); ++node) {
    const auto cells = hosts.cells_at(node);
    if (cells.empty() || !is_of_one_kind(body, places, cells) || (is_pressed && is_on_surface(hosts, node)))
      rules.may_move[at(node)] = 0;
  }
  keep_acted_on(description, body, rules.may_move);
  const auto first = 3 * at(world.body(name).first_node);
  const ConstReals x = ConstReals(state.positions).subspan(first, body.positions.size());
  rules.refused = [&hosts, x, of = std::make_shared<const BodyDescription>(std::move(body)),
                   isa = description.isa](const std::vector<NodeMove>& moves) {
    return moves_with_a_jump(*of, isa, hosts, x, moves);
  };
  return rules;
}

}  // namespace tissu
