#include "corotational_lists.h"
#include "corotational_stiffness.h"
#include "tissu/element/generated/hexahedron.h"

namespace tissu::TISSU_KERNELS {

KernelList<CorotationalKernels> corotational_hexahedron() {
  return {CorotationalTables<Hexahedron8>::all, CorotationalTables<Hexahedron8>::kCount};
}

}  // namespace tissu::TISSU_KERNELS
