#include "corotational_stiffness.h"
#include "kernel_list.h"
#include "tissu/element/generated/pyramid.h"

namespace tissu::TISSU_KERNELS {

CorotationalList corotational_pyramid() {
  return {CorotationalTables<Pyramid5>::all, CorotationalTables<Pyramid5>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
