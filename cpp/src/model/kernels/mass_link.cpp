#include "mass_link.h"

#include "link_lists.h"

namespace tissu::TISSU_KERNELS {
namespace {
constexpr MassLinkKernels kTables[] = {MassLink<LinkStVK>::table(), MassLink<LinkNeoHooke>::table()};
}  // namespace

MassLinkList mass_link_kernels() { return {kTables, sizeof(kTables) / sizeof(kTables[0])}; }

}  // namespace tissu::TISSU_KERNELS
