#pragma once

/// A plan from what was found around a cut.

#include <cstdint>
#include <vector>

#include "edit/cut/fans.h"
#include "edit/cut/fragments.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

/// The parts of each host that get nodes of their own: fragments that have the same nodes stay one cell.
struct Replicas {
  struct Replica {
    std::int32_t cell;      ///< place in the patch
    std::int32_t number;    ///< after the cut
    std::int32_t fragment;  ///< one of its fragments
    double share;           ///< of the volume of the first-day cell's material
  };
  std::vector<Replica> all;               ///< by ascending number of the host
  std::vector<std::int32_t> of_fragment;  ///< place in `all`
};
Replicas find_replicas(const Hosts& hosts, const Patch& patch, const Fragments& fragments);

/// Cells, nodes and material of the plan.
void write_plan(const Hosts& hosts, const Material& material, const Patch& patch, const Fragments& fragments,
                const Replicas& replicas, const Fans& fans, CutPlan& plan);

}  // namespace tissu
