#pragma once

/// Barycentric coordinates of the simplex of d + 1 frames, d = 0 to 3: point, segment, triangle, tetrahedron.

#include <array>

#include "affine_span.h"

namespace tissu {

struct Simplex {
  double quality = 0.0;             ///< 1 regular, 0 flat
  double excess = 0.0;              ///< sum_i |w_i|: 1 inside, more the farther the point lies outside
  std::array<double, 4> weights{};  ///< d + 1 of them
  std::array<Vec3, 4> gradients{};  ///< [1/m], within the span
};

/// At x, which is projected to the span. No weights where the simplex is flat (quality 0).
Simplex barycentric(const AffineSpan& span, const std::array<Vec3, 4>& corners, const Vec3& x);

}  // namespace tissu
