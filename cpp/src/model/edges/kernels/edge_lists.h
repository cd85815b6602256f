#pragma once

/// The kernels of the models on edges (mass-spring, mass-link, mass-tensor) for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/model/edges/mass_link_kernels.h"
#include "tissu/model/edges/mass_tensor_kernels.h"
#include "tissu/model/edges/spring_kernels.h"

TISSU_DECLARE_KERNELS(KernelList<MassLinkKernels> mass_link_kernels();
                      KernelList<MassTensorKernels> mass_tensor_kernels();
                      const SpringKernels* spring_kernels();)
