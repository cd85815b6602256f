#include "corotational_lists.h"
#include "corotational_stiffness.h"
#include "tissu/element/generated/wedge.h"

namespace tissu::TISSU_KERNELS {

KernelList<CorotationalKernels> corotational_wedge() {
  return {CorotationalTables<Wedge6>::all, CorotationalTables<Wedge6>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
