#include <algorithm>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/model/cell_editor.h"
#include "tissu/model/fem/elastic.h"
#include "tissu/model/fem/fused_kernels.h"

namespace tissu {

ModelInfo Elastic::info() {
  using enum Ability::Can;
  return {.name = "fem",
          .form = "continuum elements, any law at quadrature points",
          .laws = {},
          .elements = {},
          .poisson = {yes, "of the law"},
          .rotation = {yes, "exact, except with hooke"},
          .strain = {yes, "the law's"},
          .inversion = {partly, "stable neo-Hooke"},
          .topology = {yes, "cell by cell"}};
}

Elastic::Elastic(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads), isa_(isa) {
  choose_kernels(isa);
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  const bool blind = std::ranges::all_of(
      laws_of(block_), [&](const LawUse& use) { return law_info(block_, use).frame_invariant; });
  const RestForm form{.frames = !blind, .triangular = kernels_->triangular};
  const bool planned = block_.fill < 1.0 && reference_.dimension == 3 && !block_.cell_numbers.empty();
  planned ? lay_planned_cells(rest_positions, form) : lay_cells(rest_positions, form);
  const bool thins = reference_.dimension < 3 && block_.plane != Plane::strain;
  take_constants(lay_law_constants(block_, order_.element, thins ? reference_.dimension : 3));
  if (reference_.dimension < 3) X_.assign(rest_positions.begin(), rest_positions.end());
}

std::unique_ptr<CellEditor> Elastic::make_editor() {
  return block_.plans.empty() ? nullptr : std::make_unique<CellEditor>(*this);
}

void Elastic::choose_kernels(Isa isa) {
  for (const LawUse& use : laws_of(block_)) {
    (void)law_info(block_, use);
    laws_.push_back(use.loaded ? use.loaded->kernels(reference_.dimension)
                               : find_law_kernels(isa, use.law, reference_.dimension));
    if (laws_.back() == nullptr) {
      throw ParameterError("body \"" + block_.body + "\": the law \"" + use.law +
                           "\" needs cells with a volume, and " + block_.element + " has none.");
    }
  }
  if (options_or_defaults<FemOptions>(block_.model).fused && block_.reinforcements.empty() &&
      !block_.loaded) {
    kernels_ = find_fused_kernels(isa, block_.element, block_.law, block_.quadrature);
  }
  if (kernels_ == nullptr) kernels_ = find_shape_kernels(isa, reference_.nodes, reference_.dimension);
  if (kernels_ == nullptr) {
    throw ParameterError("body \"" + block_.body + "\": cells of type " + block_.element +
                         " cannot be simulated yet.");
  }
  gradients_ = reference_gradients();
}

}  // namespace tissu
