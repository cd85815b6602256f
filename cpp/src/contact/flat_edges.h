#pragma once

/// Edges inside a plane of what is rigid. The faces beside such an edge meet all that lies before it, so that
/// the edge by itself would only push sideways, and add friction to theirs.

#include "tissu/contact/candidates.h"
#include "tissu/contact/closest.h"

namespace tissu {

/// Nothing bends the edge, and the two faces beside it lie in one plane.
bool is_flat_edge(const SurfaceSet& surfaces, std::int32_t edge);

/// A vertex before a face, nearest to it at its rim: whether a face beside it, in the same plane and rigid
/// too, is nearer to the vertex, so that it alone meets the vertex.
bool is_before_neighbour(const SurfaceSet& surfaces, ConstReals places, const Candidate& candidate,
                         const Closest& closest);

}  // namespace tissu
