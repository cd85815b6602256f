#include "law/kernels/point.h"
#include "strain_rate.h"
#include "viscosity_lists.h"

namespace tissu::TISSU_KERNELS {
namespace {

/// No energy and no stress without a rate: what asks for them is a mistake.
template <int M>
constexpr LawKernels rate_table() {
  using At = LawAtPoints<StrainRate, M>;
  return {StrainRate<Batch>::kName, false,       M, At::kConstants, nullptr, nullptr,
          &At::stress_change,       &At::tangent};
}

constexpr LawKernels kTables[] = {rate_table<3>(), rate_table<2>(), rate_table<1>()};

}  // namespace

KernelList<LawKernels> viscous_laws() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
