#include "mean_dilatation.h"

#include "dilatation_list.h"
#include "mean_dilatation_product.h"
#include "mean_dilatation_stiffness.h"

namespace tissu::TISSU_KERNELS {
namespace {
template <int N>
constexpr MeanDilatationKernels table() {
  using Basic = MeanDilatation<N>;
  using Matrices = MeanDilatationStiffness<N>;
  return {N,
          &Basic::force,
          &MeanDilatationProduct<N>::product,
          &Matrices::stiffness,
          &Basic::energy,
          &Matrices::stress};
}
constexpr MeanDilatationKernels kTables[] = {table<4>(), table<5>(), table<6>(), table<8>()};
}  // namespace

KernelList<MeanDilatationKernels> mean_dilatation_kernels() {
  return {kTables, sizeof(kTables) / sizeof(kTables[0])};
}

}  // namespace tissu::TISSU_KERNELS
