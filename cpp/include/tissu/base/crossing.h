#pragma once

/// Which segments cross which triangles. Signs are exact (base/exact.h).

#include <array>

#include "tissu/base/vec.h"

namespace tissu {

/// Whether the closed segment a b and the closed triangle share a point. Exact for the given coordinates, in
/// the range that base/exact.h states; touching counts, in the triangle's plane too. False for a triangle
/// without area: its edges and vertices are audited by its neighbours.
bool crosses(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle);

}  // namespace tissu
