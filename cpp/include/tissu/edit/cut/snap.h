#pragma once

/// A cut that moves nodes onto the blade (Nienhuys and van der Stappen 2001; Chendeb 2007, section 4.4.2),
/// and divides cells where a node may not move.

#include <cstdint>
#include <functional>
#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"
#include "tissu/edit/cut/sweep.h"

namespace tissu {

/// Which nodes may move.
struct SnapRules {
  std::vector<char> may_move;  ///< 1 for each node that may
  /// Nodes of moves, made one after the other, that are not acceptable; empty: all are. Null: no such rule.
  std::function<std::vector<std::int32_t>(const std::vector<NodeMove>&)> refused = nullptr;
};

/// The plan of a cut by divided cells, before which nodes move onto the blade. Of each edge that the blade
/// crosses once, shortest way first, the nearer end moves to the best of a few places on the blade: where it
/// crosses an edge of the node; inside, the place nearest to the node; on the surface, the place nearest to
/// it in a face. All cells around keep a volume above 0, at rest and now, and a quality of at least
/// max(0.1, q / 3) of their quality q before; the way is at most half of the edge; nodes on the surface stay
/// in the planes of all their faces, so that the volume stays. Nodes on opened faces and on incisions, and
/// those at other cells than tetrahedra of first order, do not move.
CutPlan plan_snapped_cut(const Hosts& hosts, const Material& material, ConstReals x, const Sweep& sweep,
                         const CutOptions& options, const SnapRules& rules);

}  // namespace tissu
