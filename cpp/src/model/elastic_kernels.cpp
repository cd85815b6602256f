#include "tissu/model/elastic_kernels.h"

#include <array>
#include <span>

#include "kernels/kernel_list.h"

namespace tissu {
namespace {

struct Lists {
  std::array<KernelList, 2> fused;
  KernelList shapes;
  LawTables laws;
  LawTables viscous;
  PronyTables prony;
  const SpringKernels* springs;
};

Lists lists(Isa isa) {
#ifdef TISSU_X86_KERNELS
  if (isa == Isa::avx512) {
    using namespace avx512;
    return {{tetra_kernels(), hexahedron_kernels()},
            shape_kernels(),
            law_kernels(),
            viscous_laws(),
            prony_kernels(),
            spring_kernels()};
  }
  if (isa == Isa::avx2) {
    using namespace avx2;
    return {{tetra_kernels(), hexahedron_kernels()},
            shape_kernels(),
            law_kernels(),
            viscous_laws(),
            prony_kernels(),
            spring_kernels()};
  }
#endif
  (void)isa;
  using namespace baseline;
  return {{tetra_kernels(), hexahedron_kernels()},
          shape_kernels(),
          law_kernels(),
          viscous_laws(),
          prony_kernels(),
          spring_kernels()};
}

}  // namespace

const ElasticKernels* find_elastic_kernels(Isa isa, std::string_view element, std::string_view law,
                                           std::string_view quadrature) {
  for (const KernelList& list : lists(isa).fused) {
    for (const ElasticKernels& k : std::span(list.first, list.count)) {
      if (k.element == element && k.law == law && k.quadrature == quadrature) return &k;
    }
  }
  return nullptr;
}

const ElasticKernels* find_shape_kernels(Isa isa, int nodes, int dimension) {
  const KernelList list = lists(isa).shapes;
  for (const ElasticKernels& k : std::span(list.first, list.count)) {
    if (k.nodes == nodes && k.dimension == dimension) return &k;
  }
  return nullptr;
}

const SpringKernels* find_spring_kernels(Isa isa) { return lists(isa).springs; }

const PronyKernels* find_prony_kernels(Isa isa, int nodes) {
  const PronyTables list = lists(isa).prony;
  for (const PronyKernels& k : std::span(list.first, list.count)) {
    if (k.forces.nodes == nodes) return &k;
  }
  return nullptr;
}

const LawKernels* find_viscous_law(Isa isa, int dimension) {
  const LawTables list = lists(isa).viscous;
  for (const LawKernels& k : std::span(list.first, list.count)) {
    if (k.dimension == dimension) return &k;
  }
  return nullptr;
}

const LawKernels* find_law_kernels(Isa isa, std::string_view law, int dimension) {
  const LawTables list = lists(isa).laws;
  for (const LawKernels& k : std::span(list.first, list.count)) {
    if (k.name == law && k.dimension == dimension) return &k;
  }
  return nullptr;
}

}  // namespace tissu
