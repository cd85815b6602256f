#pragma once

/// The loops over corotational cells of each shape, for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/model/corotational/corotational_kernels.h"

TISSU_DECLARE_KERNELS(KernelList<CorotationalKernels> corotational_tetra();
                      KernelList<CorotationalKernels> corotational_hexahedron();
                      KernelList<CorotationalKernels> corotational_wedge();
                      KernelList<CorotationalKernels> corotational_pyramid();)
