#include "tissu/model/elastic_block.h"

#include <cstddef>
#include <numeric>

#include "tissu/base/error.h"
#include "tissu/cell/rest_shape.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

std::vector<double> chosen(const std::vector<double>& values, const std::vector<std::size_t>& which) {
  if (values.size() <= 1) return values;
  std::vector<double> result;
  result.reserve(which.size());
  for (const std::size_t i : which) result.push_back(values[i]);
  return result;
}

}  // namespace

void check_size(const ElasticBlock& block, const std::vector<double>& values, std::string_view what,
                std::size_t cells) {
  if (values.size() == 1 || values.size() == cells) return;
  throw ParameterError("body \"" + block.body + "\" has " + std::to_string(values.size()) + " values of " +
                       std::string(what) + " for " + std::to_string(cells) +
                       " cells; give one, or one for each cell.");
}

std::string first_five(const std::vector<std::int32_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size() && i < 5; ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(numbers[i]);
  }
  return numbers.size() > 5 ? text + ", …" : text;
}

ElasticBlock part_of(const ElasticBlock& block, const std::vector<std::size_t>& which) {
  const auto nodes = static_cast<std::size_t>(find_element(block.element)->nodes);
  ElasticBlock part = block;
  part.cells.clear();
  part.cell_numbers.clear();
  part.frames.clear();
  part.origins.clear();
  part.heirs_of.clear();
  for (const std::size_t i : which) {
    const auto insert = [&](const std::vector<std::int32_t>& from, std::vector<std::int32_t>& to) {
      const auto first = from.begin() + static_cast<std::ptrdiff_t>(i * nodes);
      to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(nodes));
    };
    insert(block.cells, part.cells);
    if (!block.frames.empty()) insert(block.frames, part.frames);
    if (!block.cell_numbers.empty()) part.cell_numbers.push_back(block.cell_numbers[i]);
    if (!block.origins.empty()) part.origins.push_back(block.origins[i]);
    if (!block.heirs_of.empty()) part.heirs_of.push_back(block.heirs_of[i]);
  }
  part.density = chosen(block.density, which);
  part.cross_section = chosen(block.cross_section, which);
  part.share = chosen(block.share, which);
  for (auto& [name, values] : part.parameters) values = chosen(values, which);
  for (LawUse& use : part.reinforcements) {
    for (auto& [name, values] : use.parameters) values = chosen(values, which);
  }
  return part;
}

std::vector<ElasticBlock> split_affine(ElasticBlock block, std::int32_t first_cell,
                                       ConstReals rest_positions) {
  const ReferenceCell reference = reference_cell(block.element, block.quadrature);
  if (reference.points.size() < 2 || block.cells.size() % static_cast<std::size_t>(reference.nodes) != 0) {
    return {std::move(block)};
  }
  const std::vector<char> affine = affine_cells(reference, block.cells, rest_positions);
  std::vector<std::size_t> which[2];
  for (std::size_t i = 0; i < affine.size(); ++i) which[affine[i] != 0 ? 0 : 1].push_back(i);
  if (which[0].empty() || which[1].empty()) return {std::move(block)};
  if (block.cell_numbers.empty()) {
    block.cell_numbers.resize(affine.size());
    std::iota(block.cell_numbers.begin(), block.cell_numbers.end(), first_cell);
  }
  return {part_of(block, which[0]), part_of(block, which[1])};
}

}  // namespace tissu
