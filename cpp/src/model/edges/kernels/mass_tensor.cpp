#include "mass_tensor.h"

#include "edge_lists.h"

namespace tissu::TISSU_KERNELS {
namespace {
constexpr MassTensorKernels kTables[] = {
    MassTensor<NodePattern>::table(),       MassTensor<EdgePattern>::table(),
    MassTensor<FacePattern>::table(),       MassTensor<TetraPattern>::table(),
    MassTensor<LinearNodePattern>::table(), MassTensor<LinearEdgePattern>::table(),
};
}  // namespace

KernelList<MassTensorKernels> mass_tensor_kernels() {
  return {kTables, sizeof(kTables) / sizeof(kTables[0])};
}

}  // namespace tissu::TISSU_KERNELS
