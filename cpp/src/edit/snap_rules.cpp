#include "snap_rules.h"

#include <algorithm>
#include <memory>
#include <unordered_map>
#include <utility>

#include "acted_on.h"
#include "cell_kinds.h"
#include "debris.h"
#include "described.h"
#include "patch_energies.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

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
  const CellKinds kinds(body);
  const bool is_pressed =
      std::ranges::any_of(description.pressures, [&](const auto& one) { return one.body == name; });
  for (std::int32_t node = 0; node < hosts.node_count(); ++node) {
    const auto cells = hosts.cells_at(node);
    if (cells.empty() || !kinds.are_alike(cells) || (is_pressed && is_on_surface(hosts, node)))
      rules.may_move[at(node)] = 0;
  }
  keep_acted_on(description, body.name, rules.may_move);
  const auto first = 3 * at(world.body(name).first_node);
  const ConstReals x = ConstReals(state.positions).subspan(first, body.positions.size());
  rules.refused = [&hosts, x, of = std::make_shared<const BodyDescription>(std::move(body)),
                   isa = description.isa](const std::vector<NodeMove>& moves) {
    return moves_with_a_jump(*of, isa, hosts, x, moves);
  };
  return rules;
}

}  // namespace tissu
