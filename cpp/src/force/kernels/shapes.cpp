#include "kernel_list.h"
#include "shape.h"

namespace tissu::TISSU_KERNELS {
namespace {
constexpr ElasticKernels kTables[] = {
    Shape<4, 3>::table(),  Shape<10, 3>::table(), Shape<8, 3>::table(),
    Shape<20, 3>::table(), Shape<27, 3>::table(), Shape<6, 3>::table(),
    Shape<15, 3>::table(), Shape<5, 3>::table(),  Shape<13, 3>::table(),
};
}  // namespace

KernelList shape_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
