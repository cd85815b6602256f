#pragma once

/// A cut through a body of a world: planned on its material, then made in a new world or in place
/// (world_editor.h).

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut_state.h"
#include "tissu/edit/edit_body.h"

namespace tissu {

/// Nothing is changed. Refuses what refuse_unparted and plan_cut refuse. A static or condensed body that
/// comes apart is the caller's to refuse: pieces() names the parts.
CutPlan plan_body_cut(const World& world, const State& state, std::string_view body, const Sweep& sweep,
                      const CutOptions& options = {});

/// Of taking cells out of a body; what hangs by an edge or a node only comes apart.
CutPlan plan_body_ablation(const World& world, std::string_view body, std::vector<std::int32_t> cells);

/// False where the blade met nothing.
bool changes(const CutPlan& plan);

struct CutWorld {
  std::shared_ptr<const World> world;
  RowsBorn born;  ///< rows of the state that take over others
  /// Of a cut that moves nodes: rows of the cells at these. Their velocities give back the momenta that the
  /// moves change (twist.h).
  std::vector<std::int32_t> around_moves;
};

/// The least quality 6 sqrt(2) V / l_rms^3 at rest of the cells of a body that a plan made or whose nodes it
/// moved, once it is made; infinite where it has none, and of other cells than tetrahedra of first order.
double least_quality(const World& world, std::string_view body, const CutPlan& plan);

/// Refuses a cut of a body after which more crosses than before it. `born`: rows that take over others.
/// `changed`: of each primitive afterwards, whether the cut may have changed it; empty: all may be.
void refuse_crossings(const Contact& before, const Contact& cut, const State& state, const RowsBorn& born,
                      std::span<const std::uint8_t> changed, std::string_view body);

/// A new world in which the plan is made. Refuses what edit_body refuses.
CutWorld cut_world(const World& world, const State& state, std::string_view body, const CutPlan& plan);

}  // namespace tissu
