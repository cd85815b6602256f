#include "tissu/edit/topology.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "debris.h"
#include "tissu/base/error.h"
#include "tissu/edit/cut_state.h"
#include "tissu/edit/edit_body.h"
#include "tissu/edit/remove_cells.h"

namespace tissu {
namespace {

/// A cell of a description, with what it is made of.
struct Listed {
  std::int32_t number;
  const ElasticBlock* block;
  std::size_t place;
};

/// All cells of a body by ascending number: edits in place leave them in the order in which they were made.
std::vector<Listed> listed(const BodyDescription& body) {
  std::vector<Listed> cells;
  for (const ElasticBlock& block : body.elastic) {
    for (std::size_t i = 0; i < block.cell_numbers.size(); ++i)
      cells.push_back({block.cell_numbers[i], &block, i});
  }
  std::ranges::sort(cells, {}, &Listed::number);
  return cells;
}

void add_cut(const BodyDescription& body, BodyTopology& to) {
  for (const auto& [number, block, place] : listed(body)) {
    to.origins.push_back(block->origins.empty() ? number : block->origins[place]);
    to.shares.push_back(of_cell(block->share, static_cast<std::int32_t>(place)));
    const std::size_t nodes = block->cells.size() / block->cell_numbers.size();
    const auto first = block->cells.begin() + static_cast<std::ptrdiff_t>(place * nodes);
    to.nodes.insert(to.nodes.end(), first, first + static_cast<std::ptrdiff_t>(nodes));
  }
  to.copies_of = body.copies_of;
  for (const FirstDayPoint& point : body.points) {
    to.point_nodes.insert(to.point_nodes.end(), point.node.begin(), point.node.end());
    to.point_weights.insert(to.point_weights.end(), point.weight.begin(), point.weight.end());
  }
  if (body.moved) to.rest = body.positions;
  to.bare = body.bare;
  to.next_cell = body.next_cell;
  to.material = pack(body.cut->material);
}

/// Loose nodes ascend, whatever the order in which they came loose.
void add_loose(const LooseNodes& loose, BodyTopology& to) {
  std::vector<std::size_t> order(loose.nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return loose.nodes[i]; });
  for (const std::size_t i : order) {
    to.loose_nodes.push_back(loose.nodes[i]);
    const auto place = loose.places.begin() + static_cast<std::ptrdiff_t>(3 * i);
    to.places.insert(to.places.end(), place, place + 3);
  }
}

std::vector<std::int32_t> ascending(std::vector<std::int32_t> numbers) {
  std::ranges::sort(numbers);
  return numbers;
}

/// Numbers of the cells that are in the world and not told.
std::vector<std::int32_t> removed_cells(const World& world, const BodyTopology& body) {
  const std::vector<std::int32_t> now = ascending(remaining_cells(world, body.body));
  const std::vector<std::int32_t> left = ascending(body.cells);
  if (!std::ranges::includes(now, left)) {
    throw ParameterError("the snapshot has cells of body \"" + body.body +
                         "\" that the world has not (any more); restore it in a simulation of the same "
                         "scene from which no cell was removed.");
  }
  std::vector<std::int32_t> removed;
  std::ranges::set_difference(now, left, std::back_inserter(removed));
  return removed;
}

/// A state of the world with loose nodes where they are held.
State with_loose_nodes(const World& world, const BodyTopology& topology) {
  State state = world.rest_state();
  const Body& body = world.body(topology.body);
  const std::int32_t nodes = body.node_count + static_cast<std::int32_t>(topology.copies_of.size());
  if (topology.places.size() != 3 * topology.loose_nodes.size()) {
    throw ParameterError("the snapshot has " + std::to_string(topology.places.size()) +
                         " numbers of loose nodes where the world has " +
                         std::to_string(3 * topology.loose_nodes.size()) +
                         "; restore it in the world that it was taken from.");
  }
  for (std::size_t i = 0; i < topology.loose_nodes.size(); ++i) {
    const std::int32_t node = topology.loose_nodes[i];
    if (node < 0 || node >= std::min(nodes, body.node_count + body.room)) {
      throw ParameterError("the snapshot holds node " + std::to_string(node) + " of body \"" + body.name +
                           "\", which has " + std::to_string(body.node_count) + " nodes.");
    }
    block(Reals(state.positions), body.first_node + node) =
        block(ConstReals(topology.places), static_cast<std::int32_t>(i));
  }
  return state;
}

[[noreturn]] void refuse(const BodyTopology& topology, const std::string& why) {
  throw ParameterError("the cuts of body \"" + topology.body + "\" do not fit: " + why +
                       "; restore them in a simulation of the same scene.");
}

/// The edit that leads from the first day to a body that was cut.
class Replay {
 public:
  Replay(const BodyDescription& body, const BodyTopology& topology) : body_(body), topology_(topology) {}
  BodyEdit edit() {
    check();
    for (const ElasticBlock& block : body_.elastic) list_cells(block);
    std::size_t node = 0;
    for (std::size_t i = 0; i < topology_.cells.size(); ++i) {
      const auto found = nodes_.find(topology_.origins[i]);
      if (found == nodes_.end())
        refuse(topology_, "the scene does not have cell " + std::to_string(topology_.origins[i]));
      const std::size_t count = found->second.size();
      if (node + count > topology_.nodes.size()) refuse(topology_, "cells lack nodes");
      add(i, std::span(topology_.nodes).subspan(node, count));
      node += count;
    }
    if (node != topology_.nodes.size()) refuse(topology_, "there are more nodes than cells have");
    std::ranges::sort(edit_.born, {}, &BodyEdit::Cell::number);
    for (const auto& [number, nodes] : nodes_) {
      if (!std::ranges::binary_search(kept_, number)) edit_.gone.push_back(number);
    }
    std::ranges::sort(edit_.gone);
    edit_.copied = topology_.copies_of;
    edit_.points = points();
    edit_.rest = topology_.rest;
    edit_.bare = topology_.bare;
    edit_.next_cell = topology_.next_cell;
    edit_.inherits = false;
    Material material = unpack(topology_.material, node_count());
    const std::vector<std::int32_t> cells = ascending(topology_.cells);
    for (const auto& [host, tetrahedra] : material.cells) {
      if (!std::ranges::binary_search(cells, host))
        refuse(topology_, "it has material of cells that are gone");
    }
    edit_.cut = std::make_shared<const CutState>(cut_state_of(edited(body_, edit_), std::move(material)));
    return std::move(edit_);
  }

 private:
  std::int32_t node_count() const {
    return static_cast<std::int32_t>(body_.positions.size() / 3 + topology_.copies_of.size());
  }
  void check() {
    if (topology_.cells.size() != topology_.origins.size() ||
        topology_.cells.size() != topology_.shares.size()) {
      refuse(topology_, "its lists differ in length");
    }
    for (std::size_t i = 0; i < topology_.cells.size(); ++i) {
      if (topology_.cells[i] == topology_.origins[i]) kept_.push_back(topology_.cells[i]);
    }
    std::ranges::sort(kept_);
    const auto is_outside = [](std::int32_t count) {
      return [count](std::int32_t node) { return node < 0 || node >= count; };
    };
    const auto first = static_cast<std::int32_t>(body_.positions.size() / 3);
    const std::vector<std::int32_t>& of_points = topology_.point_nodes;
    if (of_points.size() % 4 != 0 || topology_.point_weights.size() != of_points.size())
      refuse(topology_, "its lists differ in length");
    const auto points = static_cast<std::int32_t>(of_points.size() / 4);
    const auto is_no_root = [&](std::int32_t node) { return node < -points || node >= first; };
    if (std::ranges::any_of(topology_.copies_of, is_no_root) ||
        std::ranges::any_of(of_points, [&](std::int32_t node) { return node < -1 || node >= first; }) ||
        std::ranges::any_of(topology_.nodes, is_outside(node_count())) ||
        std::ranges::any_of(topology_.bare, is_outside(node_count()))) {
      refuse(topology_, "it names nodes that are not there");
    }
    if (!topology_.rest.empty() && topology_.rest.size() != 3 * static_cast<std::size_t>(node_count()))
      refuse(topology_, "it has places at rest of another number of nodes");
  }
  [[nodiscard]] std::vector<FirstDayPoint> points() const {
    std::vector<FirstDayPoint> points(topology_.point_nodes.size() / 4);
    for (std::size_t i = 0; i < topology_.point_nodes.size(); ++i) {
      points[i / 4].node[i % 4] = topology_.point_nodes[i];
      points[i / 4].weight[i % 4] = topology_.point_weights[i];
    }
    return points;
  }
  void list_cells(const ElasticBlock& block) {
    const std::size_t nodes = block.cells.size() / block.cell_numbers.size();
    for (std::size_t i = 0; i < block.cell_numbers.size(); ++i)
      nodes_[block.cell_numbers[i]] = std::span(block.cells).subspan(i * nodes, nodes);
  }
  void add(std::size_t i, std::span<const std::int32_t> nodes) {
    const std::int32_t number = topology_.cells[i];
    std::vector<std::int32_t> own(nodes.begin(), nodes.end());
    if (number != topology_.origins[i]) {
      edit_.born.push_back({number, topology_.origins[i], topology_.shares[i], std::move(own)});
    } else if (!std::ranges::equal(nodes, nodes_.at(number))) {
      edit_.moved.push_back({number, std::move(own)});
    }
  }

  const BodyDescription& body_;
  const BodyTopology& topology_;
  std::unordered_map<std::int32_t, std::span<const std::int32_t>> nodes_;  ///< of each cell of the first day
  std::vector<std::int32_t> kept_;
  BodyEdit edit_;
};

/// The world with one body as told; null where it is so already.
std::shared_ptr<const World> with_topology(const World& world, const BodyTopology& topology) {
  if (!topology.was_cut()) {
    const std::vector<std::int32_t> removed = removed_cells(world, topology);
    if (removed.empty()) return nullptr;
    return remove_cells(world, with_loose_nodes(world, topology), topology.body, removed);
  }
  if (world.description() == nullptr) refuse(topology, "the scene was compiled without editing");
  const auto& all = world.description()->bodies;
  const auto found = std::ranges::find(all, topology.body, &BodyDescription::name);
  if (found == all.end()) refuse(topology, "the scene has no body of this name");
  BodyDescription body = *found;
  number_cells(body);
  return edit_body(world, with_loose_nodes(world, topology), topology.body, Replay(body, topology).edit());
}

}  // namespace

std::vector<BodyTopology> topologies(const World& world) {
  std::vector<BodyTopology> result;
  if (world.description() == nullptr) return result;
  for (BodyDescription body : world.description()->bodies) {
    BodyTopology topology;
    topology.body = body.name;
    topology.cells = ascending(remaining_cells(world, body.name));
    add_loose(loose_nodes(world, body.name), topology);
    if (body.cut != nullptr) {
      number_cells(body);
      add_cut(body, topology);
    }
    result.push_back(std::move(topology));
  }
  return result;
}

std::shared_ptr<const World> with_topologies(const World& fresh, const std::vector<BodyTopology>& bodies) {
  std::shared_ptr<const World> result;
  for (const BodyTopology& topology : bodies) {
    std::shared_ptr<const World> next = with_topology(result == nullptr ? fresh : *result, topology);
    if (next != nullptr) result = std::move(next);
  }
  return result;
}

}  // namespace tissu
