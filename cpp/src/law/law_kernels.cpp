#include "tissu/law/law_kernels.h"

#include "base/kernel_choice.h"
#include "kernels/law_kernel_list.h"

namespace tissu {

const LawKernels* find_law_kernels(Isa isa, std::string_view law, int dimension) {
  return find_kernels(TISSU_KERNELS_OF(isa, law_kernels()),
                      [&](const LawKernels& k) { return k.name == law && k.dimension == dimension; });
}

}  // namespace tissu
