#include "tissu/element/generated/hexahedron.h"

#include "cell/kernels/elastic.h"
#include "fused_list.h"
#include "tissu/law/generated/hooke.h"
#include "tissu/law/generated/stvk.h"

namespace tissu::TISSU_KERNELS {
namespace {
using Full = Hexahedron8::Full;
using Over = Hexahedron8::Over;
constexpr ElasticKernels kTables[] = {
    Elastic<Hexahedron8, Full, Hooke>::table("full"),
    Elastic<Hexahedron8, Full, StVK>::table("full"),
    Elastic<Hexahedron8, Over, Hooke>::table("over"),
    Elastic<Hexahedron8, Over, StVK>::table("over"),
};
}  // namespace

KernelList<ElasticKernels> hexahedron_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
