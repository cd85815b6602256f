#pragma once

/// Which lists of kernels there are for each instruction set: one for each element. Add a new element here.

#include <cstddef>

#include "tissu/force/elastic_kernels.h"

namespace tissu {

struct KernelList {
  const ElasticKernels* first;
  std::size_t count;
};

#define TISSU_KERNEL_LISTS(isa)    \
  namespace isa {                  \
  KernelList tetra_kernels();      \
  KernelList hexahedron_kernels(); \
  }
TISSU_KERNEL_LISTS(baseline)
TISSU_KERNEL_LISTS(avx2)
TISSU_KERNEL_LISTS(avx512)
#undef TISSU_KERNEL_LISTS

}  // namespace tissu
