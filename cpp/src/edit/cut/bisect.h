#pragma once

/// The edges that a blade crosses are divided, one at a time, in one order for the whole cut.

#include <cstdint>
#include <functional>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/patch.h"

namespace tissu {

/// Puts ends of edges on the cut where a crossing is within the cell's t0 of them, and divides the other
/// edges: longest at rest first, then by the places of their ends. Vertices put on edges are on the cut. An
/// edge that the blade crosses more often is divided where the blade is nearest to its middle, and its halves
/// are tried again. `t0` gives the share for a cell of the patch. Returns the cells of the edges that are
/// left: those of unsound cells, and those crossed too often (places, ascending; second: folded). Third:
/// cells of edges that the blade passes to and fro near one end, which is on the cut in place of both
/// crossings.
struct LeftEdges {
  std::vector<std::int32_t> unsound;
  std::vector<std::int32_t> folded;
  std::vector<std::int32_t> merged;
};
/// `turned`: edges of these cells (places) are divided after all others, the shortest first. `on`: so many
/// ends of an edge may be on the cut.
LeftEdges divide_crossed(Patch& patch, std::vector<CrossedEdge> edges,
                         const std::function<double(std::int32_t)>& t0, OnCut& known,
                         const std::function<bool(std::int32_t)>& turned = {}, int on = 0);

/// Whether an edge between vertices that blades put there is so short that a crossing goes to its nearer end.
bool is_short(const Patch& patch, std::int32_t p, std::int32_t q);

/// The longest edge at rest of a tetrahedron is divided in the middle.
void divide_longest(Patch& patch, std::int32_t tetra);

}  // namespace tissu
