#pragma once

/// The edit of a body: cells go, others come in their place, and nodes part. Removal is the case without
/// others; a cut replaces each cell that it parts by one copy for each part (virtual nodes: Molino et al.
/// 2004).

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/model/cell_edit.h"
#include "tissu/state/row_blend.h"
#include "tissu/state/state.h"
#include "tissu/world/world.h"

namespace tissu {

struct BodyEdit : CellEdit {
  /// Of each new node, which follow the last: the node that it copies; -1 - i: it is at `points[i]`.
  std::vector<std::int32_t> copied;
  std::vector<Rider> between;  ///< of each, the old nodes between which it is; empty where all are copies
  std::vector<FirstDayPoint> points;  ///< all of the body after the edit
  std::vector<NodeMove> node_moves;   ///< before the new nodes come
  std::vector<double> rest;  ///< places at rest of all nodes after it; empty: they follow from the first day
  std::vector<std::int32_t> bare;  ///< nodes with cells but without material at them, ascending
  /// New cells take over what their parents remember; else every cell is there already in the world whose
  /// memory comes along.
  bool inherits = true;
  std::int32_t next_cell = 0;  ///< the number that the next cell gets; 0: one more than the last
  std::shared_ptr<const CutState> cut = nullptr;  ///< of the body after the edit
};

/// The description of a body with its cells and nodes edited, and no more.
BodyDescription edited(BodyDescription body, const BodyEdit& edit);

/// A new world of the same rows in which the body is edited. Supports and nodal loads go to those copies of a
/// node that have its material; where several have, they share a load as they share the mass. Nodes that no
/// cell uses any more stay where the state has them. Refuses a world that was not compiled for editing, cells
/// that are not there, and an edit that needs more nodes than the body has room for.
std::shared_ptr<const World> edit_body(const World& world, const State& state, std::string_view body,
                                       const BodyEdit& edit);

/// Refuses a body whose nodes cannot part, with what stands against it.
void refuse_unparted(const WorldDescription& description, const BodyDescription& body);

/// What the rows of the new nodes take over, first those between others, then copies.
struct RowsBorn {
  std::vector<RowBlend> blends;
  std::vector<RowCopy> copies;
};
/// `world` is that before the edit.
RowsBorn rows_born(const World& world, std::string_view body, const BodyEdit& edit);

}  // namespace tissu
