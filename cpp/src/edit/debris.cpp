#include "debris.h"

#include <algorithm>
#include <string>

#include "tissu/base/error.h"
#include "tissu/element/reference_cell.h"

namespace tissu {

void number_cells(BodyDescription& body) {
  std::int32_t next = 0;
  for (ElasticBlock& block : body.elastic) {
    const int nodes = reference_cell(block.element, block.quadrature).nodes;
    if (nodes == 0) continue;  // points without a mesh
    const auto count = static_cast<std::int32_t>(block.cells.size()) / nodes;
    if (block.cell_numbers.empty()) {
      for (std::int32_t i = 0; i < count; ++i) block.cell_numbers.push_back(next + i);
    }
    block.heirs_of.clear();
    next += count;
    for (const std::int32_t number : block.cell_numbers)
      body.next_cell = std::max(body.next_cell, number + 1);
  }
}

std::vector<char> used_nodes(const BodyDescription& body) {
  std::vector<char> used(body.positions.size() / 3, 0);
  for (const ElasticBlock& block : body.elastic) {
    for (const std::int32_t node : block.cells) {
      const auto own = static_cast<std::size_t>(node);  // nodes of other bodies follow the own ones
      if (own < used.size()) used[own] = 1;
    }
  }
  return used;
}

void refuse_tied(const WorldDescription& description, std::string_view body,
                 std::span<const std::int32_t> nodes) {
  for (const BodyDescription& tissue : description.bodies) {
    for (const SharedNode& tie : tissue.shared) {
      if (tie.body != body || std::ranges::find(nodes, tie.node) == nodes.end()) continue;
      throw ParameterError("body \"" + std::string(body) + "\" cannot be cut there: tissue \"" + tissue.name +
                           "\" is tied to its node " + std::to_string(tie.node) +
                           ", which would part or lose its last cell; cut away from the tissue.");
    }
  }
}

void hold_debris(WorldDescription& description, const BodyDescription& body, const State& state,
                 std::int32_t first_node) {
  const std::vector<char> used = used_nodes(body);
  FixedNodes held;
  held.body = body.name;
  held.rotations = body.frames ? FixedDofs::kAllAxes : std::uint8_t{0};
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (used[node] != 0) continue;
    held.nodes.push_back(static_cast<std::int32_t>(node));
    const Vec3 x = block(ConstReals(state.positions), first_node + static_cast<std::int32_t>(node));
    held.positions.insert(held.positions.end(), x.data(), x.data() + 3);
  }
  refuse_tied(description, body.name, held.nodes);
  // A node is led by one motion only: debris leaves what held it before.
  for (FixedNodes& other : description.fixed) {
    if (other.body != body.name) continue;
    FixedNodes rest = other;
    rest.nodes.clear();
    rest.positions.clear();
    for (std::size_t i = 0; i < other.nodes.size(); ++i) {
      if (used[static_cast<std::size_t>(other.nodes[i])] == 0) continue;
      rest.nodes.push_back(other.nodes[i]);
      if (!other.positions.empty()) {
        const auto at = other.positions.begin() + static_cast<std::ptrdiff_t>(3 * i);
        rest.positions.insert(rest.positions.end(), at, at + 3);
      }
    }
    other = std::move(rest);
  }
  if (!held.nodes.empty()) description.fixed.push_back(std::move(held));
}

}  // namespace tissu
