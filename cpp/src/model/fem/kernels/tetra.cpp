#include "tissu/element/generated/tetra.h"

#include "cell/kernels/elastic.h"
#include "fused_list.h"
#include "tissu/law/generated/hooke.h"
#include "tissu/law/generated/stvk.h"

namespace tissu::TISSU_KERNELS {
namespace {
using Full = Tetra4::Full;
constexpr ElasticKernels kTables[] = {
    Elastic<Tetra4, Full, Hooke>::table("full"),
    Elastic<Tetra4, Full, StVK>::table("full"),
};
}  // namespace

KernelList<ElasticKernels> tetra_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
