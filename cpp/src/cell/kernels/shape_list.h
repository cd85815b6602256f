#pragma once

/// The loops over any element and any law, by the element's shape, for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/cell/elastic_kernels.h"

TISSU_DECLARE_KERNELS(KernelList<ElasticKernels> shape_kernels();)
