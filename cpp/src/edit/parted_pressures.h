#pragma once

#include <vector>

#include "tissu/world/description.h"

namespace tissu {

/// Pressures on a body that was cut act on what there is of the faces of the first day: on cells that no
/// blade met as before, on others on the outer triangles of their material. Faces that a cut opened carry
/// none. The triangles lie in the faces and have the same rim, so that the resultant force stays what it was.
void part_pressures(std::vector<PressureDescription>& pressures, const BodyDescription& body);

/// Refuses pressures on curved faces, and on edges of a flat body.
void refuse_pressed(const WorldDescription& description, const BodyDescription& body);

}  // namespace tissu
