#include <algorithm>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/model/fem/elastic.h"
#include "tissu/model/fem/fused_kernels.h"

namespace tissu {
namespace {

/// Lamé's lambda, where a law has one, as in a piece that is free to thin.
void release_across(const LawInfo& law, int dimension, std::span<double> constants) {
  double* lambda = nullptr;
  double mu = 0.0;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    if (law.constants[i] == "lambda") lambda = &constants[i];
    if (law.constants[i] == "mu") mu = constants[i];
  }
  if (lambda == nullptr) return;
  *lambda = free_lambda({*lambda, mu}, dimension);
}

}  // namespace

ModelInfo Elastic::info() {
  using enum Ability::Can;
  return {.name = "fem",
          .form = "continuum elements, any law at quadrature points",
          .laws = {},
          .elements = {},
          .poisson = {yes, "of the law"},
          .rotation = {yes, "exact, but for hooke"},
          .strain = {yes, "the law's"},
          .inversion = {partly, "stable neo-Hooke"},
          .topology = {yes, "cell by cell"}};
}

Elastic::Elastic(ElasticBlock block, ConstReals rest_positions, Isa isa, Threads threads)
    : CellModel(std::move(block), threads) {
  choose_kernels(isa);
  check_laws(block_, static_cast<std::size_t>(cell_count()));
  const bool blind = std::ranges::all_of(
      laws_of(block_), [&](const LawUse& use) { return law_info(block_, use).frame_invariant; });
  lay_cells(rest_positions, {.frames = !blind, .triangular = kernels_->triangular});
  lay_law_constants();
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
  if (block_.fused && block_.reinforcements.empty() && !block_.loaded) {
    kernels_ = find_fused_kernels(isa, block_.element, block_.law, block_.quadrature);
  }
  if (kernels_ == nullptr) kernels_ = find_shape_kernels(isa, reference_.nodes, reference_.dimension);
  if (kernels_ == nullptr) {
    throw ParameterError("body \"" + block_.body + "\": cells of type " + block_.element +
                         " cannot be simulated yet.");
  }
  gradients_ = reference_gradients();
}

void Elastic::lay_law_constants() {
  const std::vector<LawUse> uses = laws_of(block_);
  bool same = true;
  std::size_t count = 0;
  for (const LawUse& use : uses) {
    count += law_info(block_, use).constants.size();
    same = same && uniform(use.parameters);
  }
  lay_constants(count, same, [&](std::size_t lane, std::span<double> constants) {
    for (const LawUse& use : uses) {
      const LawInfo& info = law_info(block_, use);
      const std::span<double> of_law = constants.first(info.constants.size());
      cell_constants(block_, use, order_.element[lane], of_law);
      if (reference_.dimension < 3 && block_.plane == Plane::stress)
        release_across(info, reference_.dimension, of_law);
      constants = constants.subspan(of_law.size());
    }
  });
}

}  // namespace tissu
