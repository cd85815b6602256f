#include "corotational_stiffness.h"
#include "kernel_list.h"
#include "tissu/element/generated/wedge.h"

namespace tissu::TISSU_KERNELS {

CorotationalList corotational_wedge() {
  return {CorotationalTables<Wedge6>::all, CorotationalTables<Wedge6>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
