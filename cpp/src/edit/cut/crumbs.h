#pragma once

/// Material that a blade would cut out though it bounds no part there.
///
/// The side of a tetrahedron is that of its vertices that are not on the cut. At a ridge of the blade the
/// faces of the cut are chords, and between ridge and chord lie tetrahedra whose vertices are all on the cut.
/// Their middle has a side, but where the ridge enters the next cell, no neighbour of that side. If each of
/// their faces opened, they would be a part of their own: a crumb.

#include <cstdint>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/crowded.h"
#include "edit/cut/patch.h"

namespace tissu {

/// An inner face whose vertices are all on the cut, and the tetrahedra on both sides.
struct InnerFace {
  std::int32_t a;
  std::int32_t b;
  double area;  ///< of an edge of triangles its length
  bool open;    ///< before this part of the sweep
  bool opens;   ///< by this part
};

/// Takes back the opening of those faces that would cut out crumbs: sets of tetrahedra (triangles of sheets)
/// that faces left closed join, and of which each vertex is on the cut. A crumb stays with the neighbours to
/// which most of its area leads. A set at the border of the body is one of the parts that the blade bounds,
/// and no crumb, if no vertex around can be seen from it past the blade. So is one between two walls.
void keep_crumbs(const Patch& patch, const Blade& blade, const OnCut& known, std::vector<InnerFace>& faces);

}  // namespace tissu
