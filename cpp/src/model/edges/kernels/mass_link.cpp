#include "mass_link.h"

#include "edge_lists.h"

namespace tissu::TISSU_KERNELS {
namespace {
constexpr MassLinkKernels kTables[] = {MassLink<LinkStVK>::table(), MassLink<LinkNeoHooke>::table()};
}  // namespace

KernelList<MassLinkKernels> mass_link_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
