#include "tissu/element/tetra.h"

#include "elastic.h"
#include "kernel_list.h"
#include "tissu/law/hooke.h"
#include "tissu/law/stvk.h"

namespace tissu::TISSU_KERNELS {
namespace {
using Full = Tetra4::Full;
constexpr ElasticKernels kTables[] = {
    Elastic<Tetra4, Full, Hooke>::table("full"),
    Elastic<Tetra4, Full, StVK>::table("full"),
};
}  // namespace

KernelList tetra_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
