#include "shape_kernels.h"
#include "shape_list.h"

namespace tissu::TISSU_KERNELS {
namespace {
constexpr ElasticKernels kTables[] = {
    ShapeKernels<4, 3>::table(),  ShapeKernels<10, 3>::table(), ShapeKernels<8, 3>::table(),
    ShapeKernels<20, 3>::table(), ShapeKernels<27, 3>::table(), ShapeKernels<6, 3>::table(),
    ShapeKernels<15, 3>::table(), ShapeKernels<5, 3>::table(),  ShapeKernels<13, 3>::table(),
    ShapeKernels<2, 1>::table(),  ShapeKernels<3, 1>::table(),  ShapeKernels<3, 2>::table(),
    ShapeKernels<6, 2>::table(),  ShapeKernels<4, 2>::table(),  ShapeKernels<8, 2>::table(),
    ShapeKernels<9, 2>::table(),
};
}  // namespace

KernelList<ElasticKernels> shape_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
