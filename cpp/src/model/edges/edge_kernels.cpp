#include "base/kernel_choice.h"
#include "kernels/edge_lists.h"

namespace tissu {

const SpringKernels* find_spring_kernels(Isa isa) { return TISSU_KERNELS_OF(isa, spring_kernels()); }

const MassLinkKernels* find_mass_link_kernels(Isa isa, std::string_view law) {
  return find_kernels(TISSU_KERNELS_OF(isa, mass_link_kernels()),
                      [&](const MassLinkKernels& k) { return k.law == law; });
}

const MassTensorKernels* find_mass_tensor_kernels(Isa isa, bool linear, int size) {
  return find_kernels(TISSU_KERNELS_OF(isa, mass_tensor_kernels()),
                      [&](const MassTensorKernels& k) { return k.linear == linear && k.size == size; });
}

}  // namespace tissu
