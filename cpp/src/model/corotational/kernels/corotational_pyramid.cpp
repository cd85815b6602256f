#include "corotational_lists.h"
#include "corotational_stiffness.h"
#include "tissu/element/generated/pyramid.h"

namespace tissu::TISSU_KERNELS {

KernelList<CorotationalKernels> corotational_pyramid() {
  return {CorotationalTables<Pyramid5>::all, CorotationalTables<Pyramid5>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
