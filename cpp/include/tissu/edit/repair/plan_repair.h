#pragma once

/// Repair of the cells that cuts leave: short edges are collapsed, flat cells are flipped, and nodes inside
/// are moved (types of bad tetrahedra: Forest 2003).

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

struct RepairOptions {
  /// A cell is bad if its q = 6 sqrt(2) V / l_rms^3 or its 3 rho_in / rho_out lies below this, or its
  /// shortest edge below twice this share of its longest. 0 to 0.5.
  double below = 0.1;
  std::int32_t most = 64;  ///< operations of one repair
  double jump = 1e-3;      ///< share of the elastic energy of its cells by which an operation may change it
  std::vector<std::int32_t> still = {};    ///< nodes that neither move nor go, ascending
  std::vector<std::int32_t> regions = {};  ///< of each first-day cell a number; cells of two do not mix
  std::vector<std::int32_t> goes_on = {};  ///< numbers of incisions that knives go on with
};

/// Cells of a patch with the places of their nodes at rest and now.
struct PatchCells {
  std::vector<std::array<std::int32_t, 4>> nodes;
  std::vector<std::array<Vec3, 4>> rest;
  std::vector<std::array<Vec3, 4>> now;
};

/// What a repair may change.
struct RepairRules {
  std::vector<char> may_move;  ///< 1 for each node that may move, and go
  std::vector<char> is_held;   ///< 1 for each node of a support
  bool surface_stays = false;  ///< no node of the surface goes
  /// Whether cells of the body have one law, density and region. Null: all have.
  std::function<bool(const std::vector<std::int32_t>&)> are_alike = nullptr;
  /// Whether the elastic energy of cells may change as it does between the two patches, made of what the cell
  /// of that number is made of. Null: it may.
  std::function<bool(std::int32_t, const PatchCells&, const PatchCells&)> allows_jump = nullptr;
};

struct RepairCounts {
  std::int32_t collapses = 0;
  std::int32_t flips = 0;
  std::int32_t moves = 0;
  std::int32_t bad_before = 0;  ///< cells that cuts made or opened
  std::int32_t bad_after = 0;
  double least_before = std::numeric_limits<double>::infinity();  ///< least q of the tetrahedra of the body
  double least_after = std::numeric_limits<double>::infinity();
};

/// A plan without new nodes.
struct RepairPlan {
  CutPlan plan;
  RepairCounts counts;
};

/// Repairs the bad cells that cuts have made or opened faces of, worst first, and of equal ones that of the
/// lowest number. An operation is made if it raises the least q of the cells that it changes by 0.1 % and
/// more, makes no more of them bad, leaves all of them a volume above 0 at rest and now, and changes their
/// volume by at most 1e-14 of the body's. Short edges are collapsed first; then cells are flipped, or nodes
/// inside move; then any edge is collapsed. Of the operations that may be made, the one with the best cells
/// is. Positions of moved nodes are read from the field before. `x`: present places.
RepairPlan plan_repair(const Hosts& hosts, const Material& material, ConstReals x, const RepairRules& rules,
                       const RepairOptions& options);

}  // namespace tissu
