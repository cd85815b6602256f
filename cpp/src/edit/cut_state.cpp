#include "tissu/edit/cut_state.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "debris.h"
#include "described.h"
#include "tissu/base/error.h"
#include "tissu/element/reference_cell.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {

const BodyDescription& described(const World& world, std::string_view name) {
  if (world.description() == nullptr) {
    throw ParameterError("this world cannot be edited; compile the scene with editing: true to cut.");
  }
  const auto& bodies = world.description()->bodies;
  const auto found = std::ranges::find(bodies, name, &BodyDescription::name);
  if (found == bodies.end())
    throw ParameterError("the scene does not have the body \"" + std::string(name) + "\".");
  return *found;
}

std::optional<CellType> host_type(const ElasticBlock& block) {
  const std::optional<CellType> volume = cell_type(block.element);
  return volume ? volume : thin_cell_type(block.element);
}

bool has_material(const BodyDescription& body) {
  return body.shared.empty() && std::ranges::all_of(body.elastic, [](const ElasticBlock& block) {
           return host_type(block).has_value();
         });
}

namespace {

std::vector<Rider> riders_of(const std::vector<FirstDayPoint>& points) {
  std::vector<Rider> riders;
  riders.reserve(points.size());
  for (const FirstDayPoint& point : points) {
    Rider& rider = riders.emplace_back();
    for (std::size_t i = 0; i < point.node.size() && point.node[i] >= 0; ++i) {
      rider.node[i] = point.node[i];
      rider.weight[i] = point.weight[i];
      ++rider.count;
    }
  }
  return riders;
}

}  // namespace

CutState cut_state_of(BodyDescription body, Material material) {
  number_cells(body);
  const auto nodes = static_cast<std::int32_t>(body.positions.size() / 3);
  const auto first_day = nodes - static_cast<std::int32_t>(body.copies_of.size());
  std::vector<std::int32_t> root(static_cast<std::size_t>(first_day));
  for (std::int32_t node = 0; node < first_day; ++node) root[static_cast<std::size_t>(node)] = node;
  root.insert(root.end(), body.copies_of.begin(), body.copies_of.end());
  std::vector<Hosts::Cell> cells;
  for (const ElasticBlock& block : body.elastic) {
    const std::optional<CellType> known = host_type(block);
    if (!known) {
      throw ParameterError("body \"" + body.name + "\" has cells of type " + block.element +
                           "; only volume cells, sheets and lines have a material that can be cut.");
    }
    const CellType type = *known;
    const ElementInfo& element = *find_element(block.element);
    const bool is_thin = info(type).dimension < 3;
    for (std::size_t i = 0; i < block.cell_numbers.size(); ++i) {
      const auto own =
          std::span(block.cells)
              .subspan(i * static_cast<std::size_t>(element.nodes), static_cast<std::size_t>(element.nodes));
      cells.push_back({block.cell_numbers[i],
                       type,
                       block.origins.empty() ? block.cell_numbers[i] : block.origins[i],
                       of_cell(block.share, static_cast<std::int32_t>(i)),
                       {own.begin(), own.end()},
                       is_thin ? of_cell(block.cross_section, static_cast<std::int32_t>(i)) : 1.0});
    }
  }
  std::ranges::sort(cells, {}, &Hosts::Cell::number);
  return {Hosts(body.positions, std::move(root), cells, body.next_cell, riders_of(body.points), body.moved),
          std::move(material)};
}

std::shared_ptr<const CutState> cut_state_now(const BodyDescription& body) {
  if (body.cut != nullptr) return body.cut;
  return body.uncut != nullptr ? body.uncut : std::make_shared<const CutState>(cut_state_of(body));
}

std::shared_ptr<const CutState> cut_state(const World& world, std::string_view name) {
  return cut_state_now(described(world, name));
}

}  // namespace tissu
