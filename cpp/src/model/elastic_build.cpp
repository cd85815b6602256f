#include <algorithm>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/model/elastic.h"

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
  lay_constants();
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
    kernels_ = find_elastic_kernels(isa, block_.element, block_.law, block_.quadrature);
  }
  if (kernels_ == nullptr) kernels_ = find_shape_kernels(isa, reference_.nodes, reference_.dimension);
  if (kernels_ == nullptr) {
    throw ParameterError("body \"" + block_.body + "\": cells of type " + block_.element +
                         " cannot be simulated yet.");
  }
  for (const ReferenceCell::Point& point : reference_.points) {
    for (const auto& gradient : point.gradients) {
      gradients_.insert(gradients_.end(), gradient.begin(), gradient.begin() + reference_.dimension);
    }
  }
}

void Elastic::lay_constants() {
  const std::vector<LawUse> uses = laws_of(block_);
  bool uniform = true;
  std::size_t count = 0;
  for (const LawUse& use : uses) {
    count += law_info(block_, use).constants.size();
    for (const auto& [name, values] : use.parameters) uniform = uniform && values.size() == 1;
  }
  const std::int32_t groups = uniform ? 1 : order_.groups();
  constants_stride_ = uniform ? 0 : static_cast<std::ptrdiff_t>(count * kLanes);
  constants_.resize(static_cast<std::size_t>(groups) * count * kLanes);
  std::vector<double> constants(count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(groups) * kLanes; ++i) {
    double* to = constants.data();
    for (const LawUse& use : uses) {
      const LawInfo& info = law_info(block_, use);
      const std::span<double> of_law{to, info.constants.size()};
      cell_constants(block_, use, order_.element[i], of_law);
      if (reference_.dimension < 3 && block_.plane == Plane::stress)
        release_across(info, reference_.dimension, of_law);
      to += info.constants.size();
    }
    for (std::size_t c = 0; c < count; ++c)
      constants_[(i / kLanes * count + c) * kLanes + i % kLanes] = constants[c];
  }
}

}  // namespace tissu
