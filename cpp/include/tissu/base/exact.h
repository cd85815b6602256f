#pragma once

/// Signs of determinants that no round-off changes.

#include "tissu/base/vec.h"

namespace tissu {

/// The sign, -1, 0 or 1, of the determinant of b - a, c - a, d - a: 1 where d lies on that side of the
/// triangle a b c to which (b - a) x (c - a) points, 0 where the four points lie in one plane. The
/// determinant in double decides where it exceeds a bound of its error, an expansion (Shewchuk 1997, Discrete
/// & Computational Geometry 18, pages 305-363) elsewhere. The sign is exact for coordinates that are 0 or
/// between 2^-305 and 2^339 in size (1e-91 and 1e102 are within); beyond that a product may leave the range
/// of double.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace tissu
