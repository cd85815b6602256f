#include "tissu/contact/broad_phase.h"

#ifdef TISSU_HAVE_FCL
#include "contact/fcl_broad_phase.h"
#endif
#include "contact/grid.h"
#include "contact/hierarchy.h"
#include "contact/octree.h"
#include "contact/sweep_and_prune.h"
#include "tissu/base/error.h"

namespace tissu {

std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseKind kind, const SearchPlan& plan) {
  switch (kind) {
    case BroadPhaseKind::hierarchy:
      return std::make_unique<Hierarchy>(plan);
    case BroadPhaseKind::sweep_and_prune:
      return std::make_unique<SweepAndPrune>(plan);
    case BroadPhaseKind::grid:
      return std::make_unique<GridBroadPhase>(plan);
    case BroadPhaseKind::octree:
      return std::make_unique<Octree>(plan);
    case BroadPhaseKind::fcl:
#ifdef TISSU_HAVE_FCL
      return std::make_unique<FclBroadPhase>(plan);
#else
      break;
#endif
  }
  throw ParameterError(
      "found the broad phase fcl, which this build has not; install libfcl-dev and build again with "
      "TISSU_WITH_FCL=ON, or name hierarchy, sweep_and_prune, grid or octree.");
}

}  // namespace tissu
