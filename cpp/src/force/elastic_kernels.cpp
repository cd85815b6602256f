#include "tissu/force/elastic_kernels.h"

#include <initializer_list>

#include "kernels/kernel_list.h"

namespace tissu {
namespace {

const ElasticKernels* find_in(std::initializer_list<KernelList> lists, std::string_view element,
                              std::string_view law, std::string_view quadrature) {
  for (const KernelList& list : lists) {
    for (std::size_t i = 0; i < list.count; ++i) {
      const ElasticKernels& k = list.first[i];
      if (k.element == element && k.law == law && k.quadrature == quadrature) return &k;
    }
  }
  return nullptr;
}

}  // namespace

const ElasticKernels* find_elastic_kernels(Isa isa, std::string_view element, std::string_view law,
                                           std::string_view quadrature) {
#ifdef TISSU_X86_KERNELS
  if (isa == Isa::avx512) {
    return find_in({avx512::tetra_kernels(), avx512::hexahedron_kernels()}, element, law, quadrature);
  }
  if (isa == Isa::avx2) {
    return find_in({avx2::tetra_kernels(), avx2::hexahedron_kernels()}, element, law, quadrature);
  }
#endif
  (void)isa;
  return find_in({baseline::tetra_kernels(), baseline::hexahedron_kernels()}, element, law, quadrature);
}

}  // namespace tissu
