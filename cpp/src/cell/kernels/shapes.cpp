#include "shape_kernels.h"
#include "shape_list.h"

namespace tissu::TISSU_KERNELS {
namespace {
constexpr PointLaws kLaws[] = {LawsAtPoint<LawsOfGroup, 1>::table(), LawsAtPoint<LawsOfGroup, 2>::table(),
                               LawsAtPoint<LawsOfGroup, 3>::table()};

template <int N, int M>
constexpr ElasticKernels kernels() {
  return ShapeKernels<N, M>::table(&kLaws[M - 1]);
}

constexpr ElasticKernels kTables[] = {
    kernels<4, 3>(),  kernels<10, 3>(), kernels<8, 3>(),  kernels<20, 3>(), kernels<27, 3>(), kernels<6, 3>(),
    kernels<15, 3>(), kernels<5, 3>(),  kernels<13, 3>(), kernels<2, 1>(),  kernels<3, 1>(),  kernels<3, 2>(),
    kernels<6, 2>(),  kernels<4, 2>(),  kernels<8, 2>(),  kernels<9, 2>(),
};
}  // namespace

KernelList<ElasticKernels> shape_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
