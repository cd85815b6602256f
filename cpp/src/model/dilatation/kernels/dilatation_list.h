#pragma once

/// The list of kernels of the model mean-dilatation for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/model/dilatation/mean_dilatation_kernels.h"

TISSU_DECLARE_KERNELS(KernelList<MeanDilatationKernels> mean_dilatation_kernels();)
