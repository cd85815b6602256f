#include "tissu/model/fem/fused_kernels.h"

#include "base/kernel_choice.h"
#include "kernels/fused_list.h"

namespace tissu {

const ElasticKernels* find_fused_kernels(Isa isa, std::string_view element, std::string_view law,
                                         std::string_view quadrature) {
  const auto made_for = [&](const ElasticKernels& k) {
    return k.element == element && k.law == law && k.quadrature == quadrature;
  };
  const ElasticKernels* found = find_kernels(TISSU_KERNELS_OF(isa, tetra_kernels()), made_for);
  return found != nullptr ? found : find_kernels(TISSU_KERNELS_OF(isa, hexahedron_kernels()), made_for);
}

}  // namespace tissu
