#pragma once

/// The loops made for one element, law and quadrature, for each instruction set.

#include "base/kernel_sets.h"
#include "tissu/cell/elastic_kernels.h"

TISSU_DECLARE_KERNELS(KernelList<ElasticKernels> tetra_kernels();
                      KernelList<ElasticKernels> hexahedron_kernels();)
