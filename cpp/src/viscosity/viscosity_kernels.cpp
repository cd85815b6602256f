#include "base/kernel_choice.h"
#include "kernels/viscosity_lists.h"
#include "tissu/viscosity/viscous_law.h"

namespace tissu {

const LawKernels* find_viscous_law(Isa isa, int dimension) {
  return find_kernels(TISSU_KERNELS_OF(isa, viscous_laws()),
                      [&](const LawKernels& k) { return k.dimension == dimension; });
}

const PronyKernels* find_prony_kernels(Isa isa, int nodes) {
  return find_kernels(TISSU_KERNELS_OF(isa, prony_kernels()),
                      [&](const PronyKernels& k) { return k.nodes == nodes; });
}

}  // namespace tissu
