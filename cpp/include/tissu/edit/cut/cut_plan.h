#pragma once

/// A cut, planned and not yet made.

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"
#include "tissu/edit/cut/sweep.h"

namespace tissu {

struct CutOptions {
  /// A crossing within this share of an edge from its end goes to the end. 0 to 0.45.
  double t0 = 0.02;
  /// Cells that the blade pierces without crossing an edge are divided first, at most three times.
  bool refine = false;
  /// Cells are divided along the cut (divide.h of the cutter), in place of copies of whole cells. Tetrahedra
  /// and triangles of first order only.
  bool divide = false;
  /// Nodes near the blade are moved onto it first, where that is allowed (snap.h of the cutter); with
  /// `divide` only.
  bool snap = false;
  /// Nodes below the edges that the blade opens are moved onto its plane too; with `snap` only.
  bool depth = false;
  std::vector<std::int32_t> still = {};  ///< nodes that are not moved, ascending
  /// A node that is on the blade's part of that number, and the place where the blade meets it.
  struct Met {
    std::size_t part;
    std::int32_t node;
    Vec3 place;
  };
  std::vector<Met> met = {};
};

/// Why the blade met a cell and did not cut it, or not as far as it went.
enum class Unresolved : std::uint8_t {
  pierced,  ///< the blade is narrower than the cell: it crosses no edge
  folded,   ///< the blade crosses an edge more often than a cut follows
  shape,    ///< the cell's material is inside out at rest, so that its edges are not divided
  flat,     ///< a part of the cell would be too flat to be a cell
  bridge,   ///< the blade passes the cell more than once; material between may stay joined
  ends      ///< a blade that parts nothing crosses its edges and ends inside
};
std::string_view words(Unresolved reason);

struct BornCell {
  std::int32_t number;
  std::int32_t parent;  ///< the host that it replaces
  double share;         ///< of the volume of the first-day cell's material
  std::vector<std::int32_t> nodes;
};
/// A host that stays, with other nodes.
struct ChangedCell {
  std::int32_t number;
  std::vector<std::int32_t> nodes;
};
/// Node first_node + i of the plan. Copies of a node ascend with it.
struct BornNode {
  std::int32_t copied;  ///< the node that it is a copy of: rest place, place, speed, history; -1: between
  bool
      material;  ///< there is material at it; else it is virtual: never loaded, held where a support needs it
  Rider between = {};  ///< the old nodes between which it is; none of a copy
};

/// What a cut does to the material, by the new numbers.
struct MaterialChange {
  std::vector<std::pair<std::int32_t, Rider>> riders_changed;              ///< places in `Material::riders`
  std::vector<Rider> riders_born;                                          ///< they follow the last one
  std::vector<std::pair<std::int32_t, std::vector<MaterialTetra>>> cells;  ///< new lists, by ascending host
  std::vector<Incision> incisions;  ///< whole, in place of those of the same number
};

/// Apply to hosts and material both, in any order; a plan belongs to the hosts it was made from.
struct CutPlan {
  std::vector<NodeMove> moved;     ///< before all that follows
  std::vector<std::int32_t> gone;  ///< hosts, ascending
  std::vector<BornCell> born;      ///< ascending numbers from `Hosts::next_cell`
  std::vector<ChangedCell> changed;
  std::int32_t first_node = 0;  ///< `Hosts::node_count` before
  std::vector<BornNode> nodes;
  std::vector<std::int32_t> emptied;  ///< touched old nodes without material at them from now on: virtual
  MaterialChange material;

  std::int32_t cells_cut = 0;     ///< hosts that have an edge divided or a face opened
  std::int32_t faces_opened = 0;  ///< triangles of the material
  double area = 0.0;              ///< of the opened faces now, one side [m2]
  double rest_area = 0.0;
  /// Material was divided or opened and no node parted: the walls move as one.
  bool parts_nothing = false;
  std::vector<std::pair<std::int32_t, Unresolved>> unresolved;  ///< by ascending host
  [[nodiscard]] std::int32_t bridges() const;                   ///< hosts that are unresolved as a bridge

  /// Nothing was opened or divided.
  [[nodiscard]] bool empty() const { return cells_cut == 0; }
};

/// The plan of a cut by virtual nodes (Molino, Bao and Fedkiw 2004; Sifakis, Der and Fedkiw 2007): each host
/// whose material parts is replaced by a replica for each part. Replicas of neighbours share a node where
/// unopened material joins them across their common face. Of the copies of a node, the one with material at
/// it keeps the number; of several, that of the cell with the lowest number. `x`: present places of all
/// nodes. Throws ParameterError for options out of their range and places that are not finite or not as many.
CutPlan plan_cut(const Hosts& hosts, const Material& material, ConstReals x, const Sweep& sweep,
                 const CutOptions& options = {});

/// The plan of taking cells out as an ablator does: what hangs by an edge or a node only comes apart.
CutPlan plan_ablation(const Hosts& hosts, const Material& material, std::vector<std::int32_t> cells);

}  // namespace tissu
