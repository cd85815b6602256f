#include "tissu/edit/remove_cells.h"

#include <algorithm>
#include <unordered_set>

#include "body_surface.h"
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

using Numbers = std::unordered_set<std::int32_t>;

/// Takes the named cells out of a block, and out of `wanted`.
void remove_from(ElasticBlock& block, Numbers& wanted) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < block.cell_numbers.size(); ++i) {
    if (wanted.erase(block.cell_numbers[i]) == 0) kept.push_back(i);
  }
  if (kept.size() < block.cell_numbers.size()) block = part_of(block, kept);
}

}  // namespace

std::shared_ptr<const World> remove_cells(const World& world, const State& state, std::string_view body,
                                          std::span<const std::int32_t> cells) {
  if (world.description() == nullptr) {
    throw ParameterError(
        "this world cannot be edited; compile the scene with editing: true to remove cells.");
  }
  WorldDescription description = *world.description();
  BodyDescription& edited = description.body(body);
  if (!edited.shared.empty() || std::ranges::any_of(edited.elastic, [](const ElasticBlock& block) {
        return find_element(block.element) == nullptr;
      })) {
    throw ParameterError("\"" + edited.name + "\" is tissue, which has points and no cells to remove; " +
                         "name a body.");
  }
  number_cells(edited);
  Numbers wanted(cells.begin(), cells.end());
  for (ElasticBlock& block : edited.elastic) remove_from(block, wanted);
  if (!wanted.empty()) {
    throw missing_cell(*std::ranges::min_element(wanted), edited.name);
  }
  edited.uncut = nullptr;
  if (edited.cut != nullptr) {
    CutState left = *edited.cut;
    left.hosts.remove(cells);
    left.material.remove(cells);
    edited.cut = std::make_shared<const CutState>(std::move(left));
  }
  std::erase_if(edited.elastic, [](const ElasticBlock& block) { return block.cells.empty(); });
  free_unneeded(description, edited);
  part_loads(description.loads, edited);
  part_pressures(description.pressures, edited);
  hold_debris(description, edited, state, world.body(body).first_node);
  renew_surface(description, edited);
  return std::make_shared<World>(std::move(description), &world);
}

std::vector<std::int32_t> remaining_cells(const World& world, std::string_view body) {
  std::vector<std::int32_t> numbers;
  for (const BodyModel* model : world.body(body).models) {
    const auto& own = model->block().cell_numbers;
    if (own.empty()) {
      const auto first = static_cast<std::int32_t>(numbers.size());
      for (std::int32_t i = 0; i < model->cell_count(); ++i) numbers.push_back(first + i);
    } else {
      numbers.insert(numbers.end(), own.begin(), own.end());
    }
  }
  return numbers;
}

LooseNodes loose_nodes(const World& world, std::string_view body) {
  LooseNodes loose;
  if (world.description() == nullptr) return loose;
  const WorldDescription& description = *world.description();
  const auto edited = std::ranges::find(description.bodies, body, &BodyDescription::name);
  if (edited == description.bodies.end()) return loose;
  const std::vector<char> used = used_nodes(*edited);
  for (const FixedNodes& fixed : description.fixed) {
    if (fixed.body != body || fixed.positions.empty()) continue;
    for (std::size_t i = 0; i < fixed.nodes.size(); ++i) {
      if (used[static_cast<std::size_t>(fixed.nodes[i])] != 0) continue;
      loose.nodes.push_back(fixed.nodes[i]);
      const auto at = fixed.positions.begin() + static_cast<std::ptrdiff_t>(3 * i);
      loose.places.insert(loose.places.end(), at, at + 3);
    }
  }
  return loose;
}

}  // namespace tissu
