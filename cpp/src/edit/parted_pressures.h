#pragma once

#include <vector>

#include "tissu/world/description.h"

namespace tissu {

/// Pressures on a body that was cut act on what there is of the faces of the first day: on faces that no
/// blade divided as before, of others on the outer triangles of the material of their cells. Faces that a cut
/// opened carry none. The nodes of a divided quad have the integrals of its shape functions over what is left
/// of it, so that its parts together give what the quad gave.
void part_pressures(std::vector<PressureDescription>& pressures, const BodyDescription& body);

/// Refuses pressures on curved faces, and on edges of a flat body.
void refuse_pressed(const WorldDescription& description, const BodyDescription& body);

}  // namespace tissu
