#include "cell_kinds.h"

#include <algorithm>

namespace tissu {
namespace {

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

}  // namespace

CellKinds::CellKinds(const BodyDescription& body) : body_(body) {
  for (std::size_t b = 0; b < body.elastic.size(); ++b) {
    const std::vector<std::int32_t>& numbers = body.elastic[b].cell_numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) places_[numbers[i]] = {b, i};
  }
}

bool CellKinds::are_alike(std::span<const std::int32_t> cells) const {
  return std::ranges::all_of(cells, [&](std::int32_t cell) {
    const Place& first = place(cells.front());
    const Place& own = place(cell);
    return own.block == first.block && alike(body_.elastic[own.block], first.cell, own.cell);
  });
}

}  // namespace tissu
