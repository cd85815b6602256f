#pragma once

/// Which lists of kernels there are for each instruction set. Add those of a new element or law here.

#include <cstddef>

#include "tissu/model/corotational_kernels.h"
#include "tissu/model/elastic_kernels.h"
#include "tissu/model/law_kernels.h"
#include "tissu/model/prony_kernels.h"
#include "tissu/model/spring_kernels.h"

namespace tissu {

struct KernelList {
  const ElasticKernels* first;
  std::size_t count;
};
struct LawTables {
  const LawKernels* first;
  std::size_t count;
};
struct PronyTables {
  const PronyKernels* first;
  std::size_t count;
};
struct CorotationalList {
  const CorotationalKernels* first;
  std::size_t count;
};

#define TISSU_KERNEL_LISTS(isa)               \
  namespace isa {                             \
  KernelList tetra_kernels();                 \
  KernelList hexahedron_kernels();            \
  KernelList shape_kernels();                 \
  LawTables law_kernels();                    \
  CorotationalList corotational_tetra();      \
  CorotationalList corotational_hexahedron(); \
  CorotationalList corotational_wedge();      \
  CorotationalList corotational_pyramid();    \
  LawTables viscous_laws();                   \
  PronyTables prony_kernels();                \
  const SpringKernels* spring_kernels();      \
  }
TISSU_KERNEL_LISTS(baseline)
TISSU_KERNEL_LISTS(avx2)
TISSU_KERNEL_LISTS(avx512)
#undef TISSU_KERNEL_LISTS

}  // namespace tissu
