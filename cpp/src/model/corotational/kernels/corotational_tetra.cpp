#include "corotational_lists.h"
#include "corotational_stiffness.h"
#include "tissu/element/generated/tetra.h"

namespace tissu::TISSU_KERNELS {

KernelList<CorotationalKernels> corotational_tetra() {
  return {CorotationalTables<Tetra4>::all, CorotationalTables<Tetra4>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
