#pragma once

/// The laws of the library at many points, for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/law/law_kernels.h"

TISSU_DECLARE_KERNELS(KernelList<LawKernels> law_kernels();)
