#include "tissu/contact/broad_phase.h"

#include "contact/hierarchy.h"
#include "tissu/base/error.h"

namespace tissu {

std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseKind kind, const SearchPlan& plan) {
  switch (kind) {
    case BroadPhaseKind::hierarchy:
      return std::make_unique<Hierarchy>(plan);
    default:
      break;
  }
  throw ParameterError(
      "found the broad phase fcl, which this build has not; install libfcl-dev and build again with "
      "TISSU_WITH_FCL=ON, or name hierarchy, sweep_and_prune, grid or octree.");
}

}  // namespace tissu
