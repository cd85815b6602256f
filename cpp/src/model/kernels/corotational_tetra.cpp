#include "corotational_stiffness.h"
#include "kernel_list.h"
#include "tissu/element/tetra.h"

namespace tissu::TISSU_KERNELS {

CorotationalList corotational_tetra() {
  return {CorotationalTables<Tetra4>::all, CorotationalTables<Tetra4>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
