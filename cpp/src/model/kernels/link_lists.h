#pragma once

/// The lists of kernels of the models mass-link and mass-tensor for each instruction set.

#include <cstddef>

#include "tissu/model/mass_link_kernels.h"
#include "tissu/model/mass_tensor_kernels.h"

namespace tissu {

struct MassLinkList {
  const MassLinkKernels* first;
  std::size_t count;
};
struct MassTensorList {
  const MassTensorKernels* first;
  std::size_t count;
};

#define TISSU_LINK_LISTS(isa)           \
  namespace isa {                       \
  MassLinkList mass_link_kernels();     \
  MassTensorList mass_tensor_kernels(); \
  }
TISSU_LINK_LISTS(baseline)
TISSU_LINK_LISTS(avx2)
TISSU_LINK_LISTS(avx512)
#undef TISSU_LINK_LISTS

}  // namespace tissu
