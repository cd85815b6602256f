#pragma once

/// Faces of the material that lie on a cut are opened.

#include <cstdint>
#include <utility>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/crowded.h"
#include "edit/cut/near.h"
#include "edit/cut/patch.h"

namespace tissu {

struct OpenedFaces {
  std::int32_t count = 0;
  double area =
      0.0;  ///< now, one side [m2]; of an edge its length times the thickness; of a line its section
  double rest_area = 0.0;              ///< [m2]
  std::vector<std::int32_t> vertices;  ///< of the opened faces, ascending
};

/// Opens each inner face whose three vertices are on the cut, whose two tetrahedra lie on different sides of
/// the blade, and which the blade covers: the mean of the three places where it met them lies within a fifth
/// of their longest distance from it, or the blade bends away from that mean, as at a ridge, but not beyond
/// its border. Faces stay closed that would cut out a crumb (crumbs.h). A face between vertices of this sweep
/// and of earlier ones of its incision is covered by both together. In a sheet the same holds for edges, in a
/// line for vertices, all of which the blade covers. Throws ParameterError where the blade follows an edge of
/// more than two triangles, or passes a node of more than two lines, of which it cannot be said which stay
/// together. A sheet or a line on cells of a higher dimension stays with those on its own side.
/// In crowded cells the side is that of one sheet of the blade on which all vertices of the face are: a
/// tetrahedron between two windings is above one and below the other. There a face opens unless it lies
/// beyond the border of the sheet.
OpenedFaces open_faces(Patch& patch, const Blade& blade, const NearCells& near, const OnCut& known,
                       double t0);

}  // namespace tissu
