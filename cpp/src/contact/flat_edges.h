#pragma once

/// Edges and vertices inside a plane of what is rigid (`SurfaceEdge::is_flat`, `SurfaceVertex::is_flat`). The
/// faces there meet the vertices of all that lies before them, so that the edges and vertices by themselves
/// would only push sideways, and add friction to theirs.

#include "tissu/contact/candidates.h"
#include "tissu/contact/closest.h"

namespace tissu {

/// Whether a candidate consists of such an edge, or of such a vertex and something that has its own vertices.
bool is_of_flat(const SurfaceSet& surfaces, const Candidate& candidate);

/// A vertex before a face: whether a face beside it, in the same plane and rigid too, is nearer to the
/// vertex, so that it alone meets the vertex. A vertex before an edge or a corner of such faces, as far as
/// round-off can say, is met by exactly one of them: all faces see it at the same place, a millionth of
/// `reach` beside its own.
bool is_before_neighbour(const SurfaceSet& surfaces, ConstReals places, const Candidate& candidate,
                         double reach);

}  // namespace tissu
