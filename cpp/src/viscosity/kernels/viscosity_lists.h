#pragma once

/// The kernels of viscosity for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/law/law_kernels.h"
#include "tissu/viscosity/prony_kernels.h"

TISSU_DECLARE_KERNELS(KernelList<LawKernels> viscous_laws(); KernelList<PronyKernels> prony_kernels();)
