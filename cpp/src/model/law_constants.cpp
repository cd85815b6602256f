#include "tissu/model/law_constants.h"

#include <vector>

#include "tissu/law/law_kernels.h"

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

LawConstants lay_law_constants(const ElasticBlock& block, std::span<const std::int32_t> cells,
                               int dimension) {
  constexpr std::size_t kLanes = LawKernels::kLanes;
  const std::vector<LawUse> uses = laws_of(block);
  bool same = true;
  std::size_t count = 0;
  for (const LawUse& use : uses) {
    count += law_info(block, use).constants.size();
    same = same && uniform(use.parameters);
  }
  const std::size_t lanes = same ? kLanes : cells.size();
  LawConstants laid;
  laid.stride = same ? 0 : static_cast<std::ptrdiff_t>(count * kLanes);
  laid.values.resize(lanes * count);
  std::vector<double> constants(count);
  for (std::size_t i = 0; i < lanes; ++i) {
    std::span<double> left = constants;
    for (const LawUse& use : uses) {
      const LawInfo& info = law_info(block, use);
      const std::span<double> of_law = left.first(info.constants.size());
      cell_constants(block, use, cells[i], of_law);
      if (dimension < 3) release_across(info, dimension, of_law);
      left = left.subspan(of_law.size());
    }
    for (std::size_t c = 0; c < count; ++c)
      laid.values[(i / kLanes * count + c) * kLanes + i % kLanes] = constants[c];
  }
  return laid;
}

}  // namespace tissu
