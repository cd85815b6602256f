#pragma once

/// The list of kernels of the model mean-dilatation for each instruction set.

#include <cstddef>

#include "tissu/model/mean_dilatation_kernels.h"

namespace tissu {

struct MeanDilatationList {
  const MeanDilatationKernels* first;
  std::size_t count;
};

namespace baseline {
MeanDilatationList mean_dilatation_kernels();
}
namespace avx2 {
MeanDilatationList mean_dilatation_kernels();
}
namespace avx512 {
MeanDilatationList mean_dilatation_kernels();
}

}  // namespace tissu
