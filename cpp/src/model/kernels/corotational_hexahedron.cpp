#include "corotational_stiffness.h"
#include "kernel_list.h"
#include "tissu/element/hexahedron.h"

namespace tissu::TISSU_KERNELS {

CorotationalList corotational_hexahedron() {
  return {CorotationalTables<Hexahedron8>::all, CorotationalTables<Hexahedron8>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
