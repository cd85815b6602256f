#include "tissu/model/cell_edit.h"

#include <algorithm>
#include <ranges>
#include <unordered_map>

#include "tissu/base/index.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

void write(const std::vector<std::int32_t>& nodes, std::int32_t first_node, std::int32_t place,
           ElasticBlock& block) {
  auto to = block.cells.begin() + static_cast<std::ptrdiff_t>(at(place) * nodes.size());
  for (const std::int32_t node : nodes) *to++ = node + first_node;
}

/// Room for half as much again: more than that moves everything once.
template <class Values>
void reserve(Values& values) {
  values.reserve(values.size() + values.size() / 2 + 64);
}

/// Calls f for each list of the block that has a number for each of its cells, but for their nodes.
template <class Function>
void for_lists(ElasticBlock& block, Function&& f) {
  const std::size_t cells = block.cell_numbers.size();
  f(block.cell_numbers);
  f(block.origins);
  f(block.share);
  const auto own = [&](std::vector<double>& values) {
    if (values.size() == cells && cells > 1) f(values);
  };
  own(block.density);
  own(block.cross_section);
  for (auto& [name, values] : block.parameters) own(values);
  for (LawUse& use : block.reinforcements) {
    for (auto& [name, values] : use.parameters) own(values);
  }
}

}  // namespace

BlockTable::BlockTable(ElasticBlock& block) : nodes_(at(find_element(block.element)->nodes)) {
  const std::size_t cells = block.cells.size() / nodes_;
  if (block.origins.empty()) block.origins = block.cell_numbers;
  if (block.share.size() == 1) block.share.assign(cells, block.share.front());
  block.heirs_of.clear();
  for_lists(block, [](auto& values) { reserve(values); });
  reserve(block.cells);
  place_.assign(at(std::ranges::max(block.cell_numbers)) + 1, -1);
  for (std::size_t i = 0; i < cells; ++i) place_[at(block.cell_numbers[i])] = static_cast<std::int32_t>(i);
}

void BlockTable::set(const CellEdit::Cell& cell, std::int32_t place, std::int32_t first_node,
                     ElasticBlock& block) {
  if (place_.size() <= at(cell.number)) place_.resize(at(cell.number) + 1, -1);
  place_[at(cell.number)] = place;
  block.cell_numbers[at(place)] = cell.number;
  block.share[at(place)] = cell.share;
  write(cell.nodes, first_node, place, block);
}

void BlockTable::bear(const CellEdit& edit, std::int32_t first_node, ElasticBlock& block) {
  std::unordered_map<std::int32_t, std::int32_t> heirs;  // where the first that is born of a cell stands
  for (const CellEdit::Cell& cell : edit.born) {
    const auto heir = heirs.find(cell.parent);
    if (heir == heirs.end()) {
      if (!has(cell.parent)) continue;
      heirs[cell.parent] = place(cell.parent);
      place_[at(cell.parent)] = -1;
      set(cell, heirs[cell.parent], first_node, block);
      continue;
    }
    const auto next = static_cast<std::int32_t>(block.cell_numbers.size());
    for_lists(block, [&](auto& values) {
      const auto value = values[at(heir->second)];
      values.push_back(value);
    });
    block.cells.resize(block.cells.size() + nodes_);
    set(cell, next, first_node, block);
  }
}

std::vector<BlockTable::Shift> BlockTable::apply(const CellEdit& edit, std::int32_t first_node,
                                                 ElasticBlock& block) {
  bear(edit, first_node, block);
  for (const CellEdit::Moved& cell : edit.moved) {
    if (has(cell.number)) write(cell.nodes, first_node, place(cell.number), block);
  }
  std::vector<Shift> shifts;
  for (const std::int32_t number : edit.gone) {
    if (!has(number)) continue;  // of another block, or with an heir
    const std::int32_t to = place(number);
    const auto from = static_cast<std::int32_t>(block.cell_numbers.size()) - 1;
    place_[at(number)] = -1;
    if (from != to) {
      place_[at(block.cell_numbers.back())] = to;
      std::copy_n(block.cells.end() - static_cast<std::ptrdiff_t>(nodes_), nodes_,
                  block.cells.begin() + static_cast<std::ptrdiff_t>(at(to) * nodes_));
      shifts.push_back({from, to, block.origins[at(from)]});
    }
    for_lists(block, [&](auto& values) {
      values[at(to)] = values.back();
      values.pop_back();
    });
    block.cells.resize(block.cells.size() - nodes_);
  }
  return shifts;
}

}  // namespace tissu
