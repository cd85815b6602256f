#pragma once

/// A cut through a body of a world: planned on its material, then made in a new world.

#include <memory>
#include <string_view>
#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut_state.h"
#include "tissu/edit/edit_body.h"

namespace tissu {

struct BodyCut {
  CutPlan plan;
  std::shared_ptr<const World> world;  ///< null: the blade met nothing
  std::vector<RowCopy> copies;         ///< rows of the state that take over others
};

/// Nothing is changed when it throws. Refuses what edit_body and plan_cut refuse, and a static or condensed
/// body that comes apart is the caller's to refuse: pieces() names the parts.
BodyCut cut_body(const World& world, const State& state, std::string_view body, const Sweep& sweep,
                 const CutOptions& options = {});

/// Takes cells out of a body; what hangs by an edge or a node only comes apart.
BodyCut ablate_body(const World& world, const State& state, std::string_view body,
                    std::vector<std::int32_t> cells);

}  // namespace tissu
