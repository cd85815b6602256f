#include "tissu/cell/elastic_kernels.h"

#include "base/kernel_choice.h"
#include "kernels/shape_list.h"

namespace tissu {

const ElasticKernels* find_shape_kernels(Isa isa, int nodes, int dimension) {
  return find_kernels(TISSU_KERNELS_OF(isa, shape_kernels()),
                      [&](const ElasticKernels& k) { return k.nodes == nodes && k.dimension == dimension; });
}

}  // namespace tissu
