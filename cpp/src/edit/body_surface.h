#pragma once

/// The surface of a body for contact, from the cells that it has. The compilation of a scene follows the same
/// rules (python/tissu/compile/contact_surface.py), so that a surface depends on the cells that are there,
/// and not on the edits that led to them.

#include "tissu/world/description.h"

namespace tissu {

/// The boundary of the volume cells, outward; sheets that do not lie inside the volume, with half their
/// thickness as radius; lines that do not run along it, with the radius of a circle of their area. Quads are
/// cut along their shorter diagonal, of equal ones along that of the lowest node. Cells need their numbers.
SurfaceDescription body_surface(const BodyDescription& body);

/// Whether the surface of a body is a mesh of its own that its cells carry, and not made of its cells.
bool has_own_mesh(const SurfaceDescription& surface);

/// After any edit of a body: its surface in the contacts of the description, if it has one, becomes that of
/// its cells, or of its material where blades met it (cut_surface.h). What contacts remember stays with the
/// vertices, edges and triangles that are still there (tissu/contact/surface_change.h).
/// A mesh of its own stays as it is; refuses to take away cells that carry its vertices.
void renew_surface(WorldDescription& description, const BodyDescription& body);

}  // namespace tissu
