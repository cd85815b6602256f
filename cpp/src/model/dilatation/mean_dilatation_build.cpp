#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "base/kernel_choice.h"
#include "kernels/dilatation_list.h"
#include "tissu/base/error.h"
#include "tissu/model/dilatation/mean_dilatation.h"

namespace tissu {
namespace {

/// A number for each set of parameters of the law that cells have, fibres apart: pressures of different
/// materials do not mix. More than kMostKinds are a graded material, whose neighbours differ little.
std::vector<std::int32_t> kinds_of(const ElasticBlock& block, std::int32_t cells) {
  constexpr std::size_t kMostKinds = 64;
  std::map<std::vector<double>, std::int32_t> kinds;
  std::vector<std::int32_t> result;
  std::vector<double> values;
  for (std::int32_t e = 0; e < cells; ++e) {
    values.clear();
    for (const auto& [name, of_cells] : block.parameters) values.push_back(of_cell(of_cells, e));
    result.push_back(kinds.try_emplace(values, static_cast<std::int32_t>(kinds.size())).first->second);
    if (kinds.size() > kMostKinds) return {};
  }
  return result;
}

}  // namespace

const MeanDilatationKernels* find_mean_dilatation_kernels(Isa isa, int nodes) {
  return find_kernels(TISSU_KERNELS_OF(isa, mean_dilatation_kernels()),
                      [&](const MeanDilatationKernels& k) { return k.nodes == nodes; });
}

ModelInfo MeanDilatation::info() {
  using enum Ability::Can;
  return {.name = "mean-dilatation",
          .form = "continuum elements with one volume ratio for a hexahedron or for some cells around a node",
          .laws = {},
          .elements = {"tetra", "hexahedron", "wedge", "pyramid"},
          .poisson = {yes, "of the law, up to 0.5 without locking"},
          .rotation = {yes, "exact, except with hooke"},
          .strain = {yes, "the law's"},
          .inversion = {partly, "stable neo-Hooke"},
          .topology = {yes, "cell by cell, the others stay in their patches"}};
}

MeanDilatation::MeanDilatation(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads), isa_(isa), X_(rest_positions.begin(), rest_positions.end()) {
  choose_kernels();
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  of_cell_ = group_cells(block_.element, block_.cells, reference_.nodes, kinds_of(block_, cell_count()));
  lay(rest_positions);
}

MeanDilatation::MeanDilatation(ElasticBlock block, std::vector<std::int32_t> of_cell,
                               ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads),
      isa_(isa),
      X_(rest_positions.begin(), rest_positions.end()),
      of_cell_(std::move(of_cell)) {
  choose_kernels();
  lay(rest_positions);
}

void MeanDilatation::lay(ConstReals rest_positions) {
  lay_cells(rest_positions, {}, of_cell_);
  table_ = patch_table(of_cell_, block_.cells, reference_.nodes, order_, shape_.volumes);
  take_constants(lay_law_constants(block_, order_.element, 3));
}

std::unique_ptr<BodyModel> MeanDilatation::without(const ElasticBlock& left,
                                                   const std::vector<std::int32_t>& removed) const {
  std::vector<std::int32_t> of_cell;
  for (std::int32_t e = 0; e < cell_count(); ++e) {
    if (!std::ranges::binary_search(removed, e)) of_cell.push_back(of_cell_[static_cast<std::size_t>(e)]);
  }
  return std::unique_ptr<BodyModel>(new MeanDilatation(left, std::move(of_cell), X_, isa_, threads_));
}

void MeanDilatation::choose_kernels() {
  kernels_ = find_mean_dilatation_kernels(isa_, reference_.nodes);
  if (kernels_ == nullptr || reference_.dimension != 3) {
    throw ParameterError("body \"" + block_.body + "\" asks for the model mean-dilatation with the element " +
                         block_.element + "; this model takes tetra, hexahedron, wedge and pyramid.");
  }
  for (const LawUse& use : laws_of(block_)) {
    (void)law_info(block_, use);
    laws_.push_back(use.loaded ? use.loaded->kernels(3) : find_law_kernels(isa_, use.law, 3));
  }
  gradients_ = reference_gradients();
}

}  // namespace tissu
